// SPDX-License-Identifier: Apache-2.0
// The board's analogue front end, as a scenario's [sensors] have it.
#pragma once
#include "sixstep/base/angle.hpp"
#include "sixstep/rig/front_end_config.hpp"
#include "sixstep/sim/instant.hpp"
#include "sixstep/study/scenario/sensors.hpp"

namespace sixstep::study {

/// A corner's time constant; 0 where there is none.
inline double lag_s(const std::optional<double>& bandwidth_Hz) {
  return bandwidth_Hz ? 1 / (2 * base::pi * *bandwidth_Hz) : 0.0;
}

/// What the controller is told as it is goes through no amplifier and no divider. Terminals that are looked at hang at
/// dividers like the bus's, whether that is read or not.
inline rig::FrontEndConfig front_end_of(const Sensors& s, bool looks_at_terminals) {
  rig::FrontEndConfig to;
  if (s.currents != rig::CurrentMeasurement::ideal) {
    to.amplifier_s = lag_s(s.current_bandwidth_Hz);
    to.amplifier_delay_ticks = sim::to_instant(s.current_delay_s).ticks;
  }
  if (s.bus == BusSensing::adc || looks_at_terminals) to.divider_s = lag_s(s.bus_bandwidth_Hz);
  return to;
}

}  // namespace sixstep::study
