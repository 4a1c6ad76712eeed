// SPDX-License-Identifier: Apache-2.0
// This file is compiled separately for a chip: freestanding, without exceptions and RTTI.
#include "sixstep/control/drive.hpp"

// Both entry points in single precision, as firmware uses them. They need no library function.
namespace firmware {

using namespace sixstep::control;

BridgeCommand<float> tick(const DriveConfig<float>& config, DriveState<float>& state,
                          const Measurement<float>& measured, const Setpoint<float>& setpoint,
                          Telemetry<float>& telemetry);
BridgeCommand<float> hall(const DriveConfig<float>& config, DriveState<float>& state, std::uint8_t code);

BridgeCommand<float> tick(const DriveConfig<float>& config, DriveState<float>& state,
                          const Measurement<float>& measured, const Setpoint<float>& setpoint,
                          Telemetry<float>& telemetry) {
  return step(config, state, measured, setpoint, telemetry);
}

BridgeCommand<float> hall(const DriveConfig<float>& config, DriveState<float>& state, std::uint8_t code) {
  return on_hall(config, state, code);
}

}  // namespace firmware
