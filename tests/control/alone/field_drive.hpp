// SPDX-License-Identifier: Apache-2.0
// The field-oriented drive as firmware uses it: the angle from a decoder, and the tick.
#pragma once
#include "sixstep/control/field/field_drive.hpp"

namespace firmware {

using namespace sixstep::control;

template <class Scalar>
struct FieldOriented {
  static LegCommands<Scalar> tick(const FieldDriveConfig<Scalar>& config, FieldDriveState<Scalar>& state,
                                  const Measurement<Scalar>& measured, BinaryAngle electrical,
                                  const Setpoint<Scalar>& setpoint, Telemetry<Scalar>& telemetry) {
    const FieldDriveInput<Scalar> input{measured,
                                        field_directions(config.advance, electrical, measured.speed_rad_s)};
    return field_drive_step(config, state, input, setpoint, telemetry);
  }
  static void take_over(FieldDriveConfig<Scalar>& config, FieldDriveState<Scalar>& state,
                        const FieldDriveConfig<Scalar>& next) {
    retune(config, state, next);
  }
};

}  // namespace firmware
