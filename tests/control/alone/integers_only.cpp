// SPDX-License-Identifier: Apache-2.0
// The product's drive in fixed point. This file is compiled without floating-point registers if the compiler
// has such an option. A floating-point operation at run time would call a library on a chip; with the option
// it does not compile.
#include "sixstep/control/derivative.hpp"
#include "sixstep/control/gates.hpp"
#include "sixstep/control/pi_positional.hpp"
#include "sixstep/control/profile.hpp"
#include "sixstep/control/protected_drive.hpp"
#include "sixstep/control/three_phase_pwm.hpp"

namespace firmware {

using namespace sixstep::control;

template <class Scalar>
struct Entries {
  static BridgeCommand<Scalar> tick(const ProtectedConfig<Scalar>& config, ProtectedState<Scalar>& state,
                                    const BoardInput& input, const Request& request,
                                    const Setpoint<Scalar>& setpoint, ProtectedTelemetry<Scalar>& telemetry) {
    return protected_step(config, state, input, request, setpoint, telemetry);
  }
  static BridgeCommand<Scalar> hall(const ProtectedConfig<Scalar>& config, ProtectedState<Scalar>& state,
                                    std::uint8_t pins, std::uint32_t captured) {
    return protected_on_hall(config, state, pins, captured);
  }
  static Scalar positional(const PiPositionalConfig<Scalar>& config, PiPositionalState<Scalar>& state,
                           Scalar error, Scalar feed_forward) {
    return pi_positional_step(config, state, error, feed_forward);
  }
  static Accumulator<Scalar> derivative(const DerivativeConfig<Scalar>& config,
                                        DerivativeState<Scalar>& state, Scalar x) {
    return derivative_step(config, state, x);
  }
  static Scalar profile(const ProfileConfig<Scalar>& config, ProfileState<Scalar>& state, Scalar target) {
    return profile_step(config, state, target);
  }
  static std::uint8_t pins(const BridgeCommand<Scalar>& command, bool on_time) {
    return gates(command, on_time);
  }
  static Dq<Scalar> currents(const Abc<Scalar>& i, const Direction<Scalar>& d_axis) {
    return park(clarke(i), d_axis);
  }
  static LegCommands<Scalar> legs(const Dq<Scalar>& v, const Direction<Scalar>& d_axis, Scalar bus_V) {
    return space_vector(inverse_clarke(inverse_park(v, d_axis)), bus_V);
  }
  static std::uint8_t pins_of_leg(const LegCommand<Scalar>& command, Leg leg, bool pulse) {
    return gates(command, leg, pulse);
  }
};

template struct Entries<Q15>;
template struct Entries<Fixed<std::int16_t, 12>>;
template struct Entries<Q31>;
template struct Entries<Fixed<std::int32_t, 24>>;

}  // namespace firmware
