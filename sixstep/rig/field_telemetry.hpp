// SPDX-License-Identifier: Apache-2.0
// Values that a field-oriented drive holds from one sample to the next, in SI for any arithmetic. Figures of
// merit and recorders read them.
#pragma once
#include "sixstep/control/frames.hpp"

namespace sixstep::rig {

struct FieldTelemetry {
  control::Dq<double> measured_A{}, reference_A{};
  control::Dq<double> voltage_V{};  ///< commanded phase voltage, in the rotor's frame
  double angle_error_deg = 0.0;     ///< electrical: assumed angle of the magnet minus the true angle
};

/// Values of a field-oriented firmware; zeros for other firmwares.
template <class Firmware>
FieldTelemetry field_held(const Firmware& firmware) {
  if constexpr (requires { firmware.field_held(); })
    return firmware.field_held();
  else
    return {};
}

}  // namespace sixstep::rig
