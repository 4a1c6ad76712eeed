// SPDX-License-Identifier: Apache-2.0
// Finds which end of the magnet's axis is north, after injection.hpp has found the axis. A current along the
// axis that adds to the magnet's field saturates the iron (symbols of model.md 7),
//
//   L_d(i_d) = L_d (1 - i_d/I_sat),   h_d = V T/L_d(i_d)
//
// and the response h_d to the pulse is then larger. V is the pulse's voltage, T its period. First the current
// I flows along the assumed axis, then -I. h+ and h- are the two responses:
//
//   (h+ - h-)/(h+ + h-) = +-I/I_sat
//
// Neither current causes torque, because both are along the axis. A result below `certain` is rejected: the
// iron does not saturate, or the noise is as large as the result.
#pragma once
#include <cstdint>

#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

enum class NorthPhase : std::uint8_t { forth, back, found, opposite, unseen };

template <class Scalar>
struct PolarityConfig {
  Scalar current_A{};              ///< I, current along the axis
  Gain<Scalar> certain{};          ///< least accepted |(h+ - h-)/(h+ + h-)|
  std::uint16_t settle_ticks = 0;  ///< ticks after each change until the current is constant
  std::uint16_t look_ticks = 0;    ///< ticks after settle_ticks over which h_d is summed
  bool operator==(const PolarityConfig&) const = default;
};

template <class Scalar>
struct NorthState {
  NorthPhase phase = NorthPhase::forth;
  std::uint16_t ticks = 0;
  Accumulator<Scalar> forth{}, back{};  ///< sums of h_d with the current I and with -I, A
};

/// Reference of i_d, A.
template <class Scalar>
constexpr Scalar north_current(const PolarityConfig<Scalar>& config, const NorthState<Scalar>& state) {
  if (state.phase == NorthPhase::forth) return config.current_A;
  return state.phase == NorthPhase::back ? -config.current_A : Scalar{};
}

/// The result (h+ - h-)/(h+ + h-); a positive sign means that the assumed end is north.
template <class Scalar>
constexpr Scalar north_seen(const NorthState<Scalar>& state) {
  const Scalar sum = state.forth + state.back;
  return sum > Scalar{} ? (state.forth - state.back) / sum : Scalar{};
}

/// One tick with its response h_d, A.
template <class Scalar>
constexpr void north_step(const PolarityConfig<Scalar>& config, NorthState<Scalar>& state, Scalar h_d) {
  if (state.phase != NorthPhase::forth && state.phase != NorthPhase::back) return;
  if (++state.ticks <= config.settle_ticks) return;
  (state.phase == NorthPhase::forth ? state.forth : state.back) += h_d;
  if (state.ticks < config.settle_ticks + config.look_ticks) return;
  state.ticks = 0;
  if (state.phase == NorthPhase::forth) {
    state.phase = NorthPhase::back;
    return;
  }
  const Scalar seen = north_seen(state);
  state.phase = magnitude(seen) < config.certain ? NorthPhase::unseen
                : seen < Scalar{}                ? NorthPhase::opposite
                                                 : NorthPhase::found;
}

}  // namespace sixstep::control
