// SPDX-License-Identifier: Apache-2.0
// Values of a field-oriented drive that are constant between two samples, in SI units for every arithmetic.
// Figures of merit and recorders read these values.
#pragma once
#include "sixstep/control/frames.hpp"

namespace sixstep::rig {

struct FieldTelemetry {
  control::Dq<double> measured_A{}, reference_A{};
  control::Dq<double> voltage_V{};  ///< commanded phase voltage, in the rotor's frame
  double angle_error_deg = 0.0;     ///< electrical: assumed angle of the magnet minus the true angle
};

/// The values of a field-oriented firmware; zeros for other firmwares.
template <class Firmware>
FieldTelemetry field_held(const Firmware& firmware) {
  if constexpr (requires { firmware.field_held(); })
    return firmware.field_held();
  else
    return {};
}

}  // namespace sixstep::rig
