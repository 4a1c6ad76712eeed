// SPDX-License-Identifier: Apache-2.0
// This file is compiled separately for a chip: freestanding, without exceptions and RTTI.
#include "sixstep/control/protected_drive.hpp"

// Both entry points of the product's drive in single precision, as firmware uses them.
namespace firmware {

using namespace sixstep::control;

BridgeCommand<float> tick(const ProtectedConfig<float>& config, ProtectedState<float>& state,
                          const BoardInput& input, const Request& request, const Setpoint<float>& setpoint,
                          ProtectedTelemetry<float>& telemetry);
BridgeCommand<float> hall(const ProtectedConfig<float>& config, ProtectedState<float>& state,
                          std::uint8_t pins, std::uint32_t captured);

BridgeCommand<float> tick(const ProtectedConfig<float>& config, ProtectedState<float>& state,
                          const BoardInput& input, const Request& request, const Setpoint<float>& setpoint,
                          ProtectedTelemetry<float>& telemetry) {
  return protected_step(config, state, input, request, setpoint, telemetry);
}

BridgeCommand<float> hall(const ProtectedConfig<float>& config, ProtectedState<float>& state,
                          std::uint8_t pins, std::uint32_t captured) {
  return protected_on_hall(config, state, pins, captured);
}

}  // namespace firmware
