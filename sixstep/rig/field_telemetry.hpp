// SPDX-License-Identifier: Apache-2.0
// What a field-oriented drive holds from one sample to the next, in SI: what figures and recorders see of it, whatever it
// computes in.
#pragma once
#include "sixstep/control/frames.hpp"

namespace sixstep::rig {

struct FieldTelemetry {
  control::Dq<double> measured_A{}, reference_A{};
  control::Dq<double> voltage_V{};  ///< of a phase, as asked for
  double angle_error_deg = 0.0;     ///< electrical: where the magnet is taken to point, less where it does
};

/// That of a firmware that has it; of any other zeros.
template <class Firmware>
FieldTelemetry field_held(const Firmware& firmware) {
  if constexpr (requires { firmware.field_held(); })
    return firmware.field_held();
  else
    return {};
}

}  // namespace sixstep::rig
