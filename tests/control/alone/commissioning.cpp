// SPDX-License-Identifier: Apache-2.0
// Commissioning and the start by pulses in fixed point, as firmware uses them. This file is compiled without
// floating-point registers if the compiler has such an option.
#include "sixstep/control/commissioning/commissioning_result.hpp"
#include "sixstep/control/commissioning/pulse_start.hpp"

namespace firmware {

using namespace sixstep::control;

template <class Scalar>
struct Commissioner {
  static LegCommands<Scalar> step(const CommissioningConfig& config, CommissioningState& state,
                                  const CommissioningInput& input) {
    return commissioning_step<Scalar>(config, state, input);
  }
  static Commissioned<Scalar> found(const CommissioningScale<Scalar>& scale,
                                    const CommissioningState& state) {
    return commissioned<Scalar>(scale, state);
  }
  static const BridgeCommand<Scalar>& start(const PulsedDriveConfig<Scalar>& config,
                                            PulsedDriveState<Scalar>& state,
                                            const PulsedDriveInput<Scalar>& input,
                                            const Setpoint<Scalar>& setpoint, Telemetry<Scalar>& telemetry) {
    return pulsed_drive_step(config, state, input, setpoint, telemetry);
  }
};

template struct Commissioner<Q15>;
template struct Commissioner<Q31>;

void hall_edge(const CommissioningConfig& config, CommissioningState& state, std::uint8_t pins,
               std::uint32_t captured);

void hall_edge(const CommissioningConfig& config, CommissioningState& state, std::uint8_t pins,
               std::uint32_t captured) {
  commissioning_hall(config, state, pins, captured);
}

}  // namespace firmware
