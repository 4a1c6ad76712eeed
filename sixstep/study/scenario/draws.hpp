// SPDX-License-Identifier: Apache-2.0
// Decides whether a run of a scenario draws random numbers.
#pragma once
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// True if the run draws no random numbers. A run draws them for the converters' noise, for Hall glitches,
/// and for the drives of a series.
inline bool draws_nothing(const Scenario& s) {
  const Sensors& x = s.sensors;
  return x.currents == rig::CurrentMeasurement::ideal && x.bus == BusSensing::ideal &&
         x.rotor == RotorSensing::ideal && !(x.hall_glitches_Hz > 0) &&
         s.control.drive != FirmwareKind::sensorless && s.spread.empty();
}

}  // namespace sixstep::study
