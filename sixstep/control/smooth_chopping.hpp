// SPDX-License-Identifier: Apache-2.0
// Selects the chopping so that the current has no jump at the duty d = 0. With ideal soft chopping no current
// flows at d -> 0+, and d -> 0- is a full short-circuit brake (model.md 4b). If d changes its sign at the
// speed w, the voltage jumps by the back-EMF 2 K_e w, and the current by 2 K_e w/R_tt (R_tt: terminal
// resistance). Complementary chopping applies d U_s at both signs, without a jump. It has two disadvantages.
// It always switches both transistors of a leg, with dead time and switching loss. At light load the current
// reverses.
//
// While the driven current flows in the direction of the command during the whole period, both choppings form
// the same circuit: the lower diode conducts in place of the lower switch. s is the sign of the command. The
// chopping is therefore soft if s i_m is above `soft_above_A`, and complementary if s i_m is below
// `complementary_below_A`. Between the two levels it does not change. Choose the lower level above half of
// the current's peak-to-peak ripple, which is at most U_s T_s/(4 L_tt) (at d = 1/2). The change of chopping
// then causes no jump.
#pragma once
#include "sixstep/control/bridge_command.hpp"

namespace sixstep::control {

/// Default: the chopping is complementary without a driven current, and soft with any driven current.
template <class Scalar>
struct SmoothChoppingConfig {
  Scalar soft_above_A{};
  Scalar complementary_below_A{};  ///< must be below soft_above_A
  bool operator==(const SmoothChoppingConfig&) const = default;
};

template <class Scalar>
struct SmoothChoppingState {
  Chopping chopping = Chopping::complementary;
};

/// One tick: returns the chopping. `reversed`: the sign s of the command. `motor_current_A`: positive for
/// positive torque.
template <class Scalar>
constexpr Chopping smooth_chopping_step(const SmoothChoppingConfig<Scalar>& config,
                                        SmoothChoppingState<Scalar>& state, bool reversed,
                                        Scalar motor_current_A) {
  const Scalar driven = reversed ? -motor_current_A : motor_current_A;
  if (driven > config.soft_above_A) state.chopping = Chopping::soft;
  if (!(driven > config.complementary_below_A)) state.chopping = Chopping::complementary;
  return state.chopping;
}

}  // namespace sixstep::control
