// SPDX-License-Identifier: Apache-2.0
// Chopping that stays smooth through d = 0. With ideal soft chopping d -> 0+ lets no current flow and d -> 0-
// is a full short-circuit brake (model.md 4b): a loop that crosses zero at speed meets a jump of 2 K_e
// w/R_tt. Complementary chopping applies d U_s at both signs, with no jump, but switches a leg's two
// transistors against each other all the time: dead time and switching loss, and at light load a current that
// reverses.
//
// While the driven current flows the whole period in the direction of the command, both are the same circuit
// (the lower diode conducts in place of the lower switch). So: soft where s i_m is above `soft_above_A`,
// complementary below `complementary_below_A`; between them the last choice stays. Take the lower level above
// half of the current's peak-to-peak ripple, U_s T_s/(4 L_tt)/2 at d = 1/2, and the change is no jump either.
#pragma once
#include "sixstep/control/bridge_command.hpp"

namespace sixstep::control {

/// The default is complementary as long as no current flows, soft with any.
template <class Scalar>
struct SmoothChoppingConfig {
  Scalar soft_above_A{};
  Scalar complementary_below_A{};  ///< below soft_above_A
  bool operator==(const SmoothChoppingConfig&) const = default;
};

template <class Scalar>
struct SmoothChoppingState {
  Chopping chopping = Chopping::complementary;
};

/// `reversed`: the sign s of the command; `motor_current_A` in the positive direction.
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
