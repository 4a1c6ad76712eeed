// SPDX-License-Identifier: Apache-2.0
// Where the magnet's axis lies, from standstill on: a voltage V along the axis as it is taken to lie, up in one PWM period and
// down in the next, and what it makes of the current. Of a rotor whose axis lies e ahead of that (model.md 7, over a
// period T as short as R does not count)
//
//   up less down, halved:   h_d = V T (Y_S + Y_D cos 2e),   h_q = V T Y_D sin 2e
//   Y_S = (1/L_d + 1/L_q)/2,   Y_D = (1/L_d - 1/L_q)/2
//
// A current along the axis alone says that it is met; h_q/(2 V T Y_D) is e where e is small, and pulls the right way up to 90
// degrees off (Yoon, Sul, Morimoto and Ide, High-Bandwidth Sensorless Algorithm for AC Machines Based on Square-Wave-Type Voltage
// Injection, IEEE Trans. IA 47, 2011). It shows the axis, not which of its ends is north (polarity.hpp).
//
// The drive's own currents change too, and by more than the pulse does where a current is stepped. Of the changes D in three periods
// (D[n] - 2 D[n-1] + D[n-2])/4 is what turns with the pulse, a period old; of a current that runs along a parabola nothing is left
// in it. The mean of two samples that follow each other is free of the pulse, and is what the current loops are told, half a
// period late. Samples lie at the begin of a period: in its middle the pulse's current is zero. In floating point: nobody has
// proved a scaling.
#pragma once
#include <cstdint>

#include "sixstep/control/frames.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

/// The default injects nothing.
template <class Scalar>
struct InjectionConfig {
  Scalar voltage_V{};        ///< V, of a phase
  Gain<Scalar> rad_per_A{};  ///< 1/(2 V T Y_D); below 0 where L_d > L_q
  bool operator==(const InjectionConfig&) const = default;
};

template <class Scalar>
struct InjectionState {
  AlphaBeta<Scalar> current{};      ///< of the last sample, A
  Dq<Scalar> change{};              ///< by how much it differed from the one before, in its period's frame
  Dq<Scalar> turn{};                ///< half of what that differed from the change before
  Direction<Scalar> answered[3]{};  ///< along which the last ticks' answers pulse, the newest first
  std::uint8_t up = 0;              ///< bit n: the answer of n ticks ago pulsed up
  std::uint8_t pulses = 0;          ///< bit n: it pulsed at all
};

namespace detail {

/// Whether the periods before the last two samples, answered n and n + 1 ticks before the last tick, had a pulse each.
constexpr bool pulsed_twice(std::uint8_t pulses, std::uint8_t n) { return ((pulses >> n) & 3u) == 3u; }
constexpr bool pulsed_thrice(std::uint8_t pulses, std::uint8_t n) { return ((pulses >> n) & 7u) == 7u; }

}  // namespace detail

/// One sample: h, A, in the frame that the pulse was made in; nothing where no pulse lies behind. n: ticks from an answer to its
/// period, 2 at most.
template <class Scalar>
constexpr Dq<Scalar> injection_response(InjectionState<Scalar>& state, const AlphaBeta<Scalar>& current,
                                        std::uint8_t n) {
  using T = ScalarTraits<Scalar>;
  const Dq<Scalar> change =
      park(AlphaBeta<Scalar>{current.alpha - state.current.alpha, current.beta - state.current.beta},
           state.answered[n]);
  const Dq<Scalar> turn{T::half_difference(change.d, state.change.d),
                        T::half_difference(change.q, state.change.q)};
  const Dq<Scalar> h{T::half_difference(turn.d, state.turn.d), T::half_difference(turn.q, state.turn.q)};
  state.turn = turn;
  state.current = current;
  state.change = change;
  if (!detail::pulsed_thrice(state.pulses, n)) return {};
  return ((state.up >> n) & 1u) != 0 ? h : Dq<Scalar>{-h.d, -h.q};
}

/// The pulse of this tick's answer, V along the axis as it will lie then; up after down.
template <class Scalar>
constexpr Scalar injected_voltage(const InjectionConfig<Scalar>& config, InjectionState<Scalar>& state,
                                  const Direction<Scalar>& along, bool on) {
  state.answered[2] = state.answered[1];
  state.answered[1] = state.answered[0];
  state.answered[0] = along;
  const bool up = (state.up & 1u) == 0;
  state.up = static_cast<std::uint8_t>(state.up << 1 | (up ? 1u : 0u));
  state.pulses = static_cast<std::uint8_t>(state.pulses << 1 | (on ? 1u : 0u));
  return !on ? Scalar{} : up ? config.voltage_V : -config.voltage_V;
}

}  // namespace sixstep::control
