// SPDX-License-Identifier: Apache-2.0
// Selects the chopping so that the current is smooth through d = 0. With ideal soft chopping no current flows
// at d -> 0+, and d -> 0- is a full short-circuit brake (model.md 4b): for a loop that crosses zero at speed,
// the voltage jumps by 2 K_e w, the current by 2 K_e w/R_tt. Complementary chopping applies d U_s at both
// signs, without a jump. But it always switches both transistors of a leg, with dead time and switching loss,
// and at light load the current reverses.
//
// While the driven current flows in the direction of the command during the whole period, both choppings form
// the same circuit (the lower diode conducts in place of the lower switch). The chopping is therefore soft if
// s i_m is above `soft_above_A`, complementary if it is below `complementary_below_A`, and unchanged between
// the two. Choose the lower level above half of the current's peak-to-peak ripple, U_s T_s/(4 L_tt)/2 at d =
// 1/2: then the change of chopping does not cause a jump.
#pragma once
#include "sixstep/control/bridge_command.hpp"

namespace sixstep::control {

/// With the default the chopping is complementary while no current flows, and soft with any current.
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
