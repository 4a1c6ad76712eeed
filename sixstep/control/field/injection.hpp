// SPDX-License-Identifier: Apache-2.0
// Finds the magnet's axis, also at standstill. A voltage along the assumed axis is +V in one PWM period and
// -V in the next period. The current's response shows the angle e by which the rotor's axis is ahead of the
// assumed axis. The period T is so short that R has no effect (symbols of model.md 7):
//
//   half of the difference between the current's change in a +V period and in a -V period:
//     h_d = V T (Y_S + Y_D cos 2e),   h_q = V T Y_D sin 2e
//   Y_S = (1/L_d + 1/L_q)/2,   Y_D = (1/L_d - 1/L_q)/2
//
// h_q is 0 if the assumed axis is right. h_q/(2 V T Y_D) is e for small e, and has the right sign for errors
// up to 90 degrees (Yoon, Sul, Morimoto and Ide, High-Bandwidth Sensorless Algorithm for AC Machines Based on
// Square-Wave-Type Voltage Injection, IEEE Trans. IA 47, 2011). The response shows the axis, but not which of
// its ends is north (polarity.hpp).
//
// The current loops also change the currents. A step of the reference changes the current more than the pulse
// does. D[n] is the change of the current in period n. (D[n] - 2 D[n-1] + D[n-2])/4 is the part that
// alternates with the pulse. It is one period old. A current that follows a parabola does not contribute to
// this part. The mean of two consecutive samples does not contain the pulse. The current loops use this mean,
// which is half a period old. The currents are sampled at the begin of a period, because the pulse's current
// is 0 in the middle of a period. This method exists in floating point only, because its scaling is not
// proved.
#pragma once
#include <cstdint>

#include "sixstep/control/frames.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

/// Default: no injection.
template <class Scalar>
struct InjectionConfig {
  Scalar voltage_V{};        ///< V, of a phase; 0: no injection
  Gain<Scalar> rad_per_A{};  ///< 1/(2 V T Y_D); below 0 if L_d > L_q
  bool operator==(const InjectionConfig&) const = default;
};

template <class Scalar>
struct InjectionState {
  AlphaBeta<Scalar> current{};      ///< current at the last sample, A
  Dq<Scalar> change{};              ///< change of the current since the previous sample, A, in the frame of
                                    ///< the period between
  Dq<Scalar> turn{};                ///< half of (`change` minus the previous change), A
  Direction<Scalar> answered[3]{};  ///< directions of the pulses in the last ticks, newest first
  std::uint8_t up = 0;              ///< bit n is 1: the output of n ticks ago had a pulse of +V
  std::uint8_t pulses = 0;          ///< bit n is 1: the output of n ticks ago had a pulse
};

namespace detail {

/// True if each of the two periods before the last sample had a pulse. The outputs of n and n + 1 ticks ago
/// commanded these periods.
constexpr bool pulsed_twice(std::uint8_t pulses, std::uint8_t n) { return ((pulses >> n) & 3u) == 3u; }
constexpr bool pulsed_thrice(std::uint8_t pulses, std::uint8_t n) { return ((pulses >> n) & 7u) == 7u; }

}  // namespace detail

/// One sample: returns h, A, in the frame of the pulse; 0 if the periods before had no pulses. n: ticks from
/// an output to the begin of its period, at most 2.
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

/// Voltage of the pulse in this tick's output, alternately V and -V. `along`: the axis when the output acts.
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
