// SPDX-License-Identifier: Apache-2.0
// The sensorless drive as firmware uses it: tick, compare match and Hall interrupt.
#pragma once
#include "sixstep/control/sensorless/sensorless_drive.hpp"

namespace firmware {

using namespace sixstep::control;

template <class Scalar>
struct Sensorless {
  static BridgeCommand<Scalar> tick(const SensorlessDriveConfig<Scalar>& config,
                                    SensorlessDriveState<Scalar>& state,
                                    const SensorlessDriveInput<Scalar>& input,
                                    const Setpoint<Scalar>& setpoint, Telemetry<Scalar>& telemetry) {
    return sensorless_drive_step(config, state, input, setpoint, telemetry);
  }
  static bool compare(const SensorlessDriveState<Scalar>& state, std::uint32_t& at) {
    return next_commutation(state, at);
  }
  static BridgeCommand<Scalar> match(const SensorlessDriveConfig<Scalar>& config,
                                     SensorlessDriveState<Scalar>& state, std::uint32_t now) {
    return sensorless_drive_commutate(config, state, now);
  }
  static bool hall(const SensorlessDriveConfig<Scalar>& config, SensorlessDriveState<Scalar>& state,
                   std::uint8_t pins, std::uint32_t captured) {
    return sensorless_drive_hall(config, state, pins, captured);
  }
};

}  // namespace firmware
