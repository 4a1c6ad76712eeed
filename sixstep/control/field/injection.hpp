// SPDX-License-Identifier: Apache-2.0
// Finds the magnet's axis, from standstill on: applies a voltage V along the assumed axis, up in one PWM period
// and down in the next, and evaluates the response of the current. For a rotor whose axis is e ahead of the
// assumed one (model.md 7, over a period T so short that R does not matter)
//
//   up less down, halved:   h_d = V T (Y_S + Y_D cos 2e),   h_q = V T Y_D sin 2e
//   Y_S = (1/L_d + 1/L_q)/2,   Y_D = (1/L_d - 1/L_q)/2
//
// A response along the assumed axis alone means that the axis is right. h_q/(2 V T Y_D) is e for small e, and
// has the right sign for errors up to 90 degrees (Yoon, Sul, Morimoto and Ide, High-Bandwidth Sensorless
// Algorithm for AC Machines Based on Square-Wave-Type Voltage Injection, IEEE Trans. IA 47, 2011). It shows the
// axis, not which of its ends is north (polarity.hpp).
//
// The drive's own currents change too, and by more than the pulse does if a current is stepped. Of the changes
// D in three periods (D[n] - 2 D[n-1] + D[n-2])/4 is the part that alternates with the pulse, a period old; a
// current that runs along a parabola leaves nothing in it. The mean of two consecutive samples is free of the
// pulse; the current loops use it, half a period late. Samples are at the begin of a period, because in its
// middle the pulse's current is zero. It exists in floating point only, because its scaling is not proved.
#pragma once
#include <cstdint>

#include "sixstep/control/frames.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

/// With the default nothing is injected.
template <class Scalar>
struct InjectionConfig {
  Scalar voltage_V{};        ///< V, of a phase
  Gain<Scalar> rad_per_A{};  ///< 1/(2 V T Y_D); below 0 where L_d > L_q
  bool operator==(const InjectionConfig&) const = default;
};

template <class Scalar>
struct InjectionState {
  AlphaBeta<Scalar> current{};      ///< current of the last sample, A
  Dq<Scalar> change{};              ///< its difference from the sample before, in its period's frame
  Dq<Scalar> turn{};                ///< half of the difference from the change before
  Direction<Scalar> answered[3]{};  ///< directions of the last ticks' pulses, the newest first
  std::uint8_t up = 0;              ///< bit n: the output of n ticks ago pulsed up
  std::uint8_t pulses = 0;          ///< bit n: the output of n ticks ago pulsed
};

namespace detail {

/// True if each of the periods before the last two samples, commanded n and n + 1 ticks before the last tick,
/// had a pulse.
constexpr bool pulsed_twice(std::uint8_t pulses, std::uint8_t n) { return ((pulses >> n) & 3u) == 3u; }
constexpr bool pulsed_thrice(std::uint8_t pulses, std::uint8_t n) { return ((pulses >> n) & 7u) == 7u; }

}  // namespace detail

/// One sample: returns h, A, in the frame of its pulse; 0 without pulses before. n: ticks from an output to its
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

/// The pulse of this tick's output, V along the axis as it will be then; up after down.
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
