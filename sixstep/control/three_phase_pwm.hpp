// SPDX-License-Identifier: Apache-2.0
// Converts three phase voltages to the duties of three complementary legs (model.md 11):
//
//   d_k = 1/2 + (v_k + v_0)/U_s, clamped to [0, 1]
//   sine-triangle   v_0 = 0                      undistorted up to a phase voltage of U_s/2
//   space vector    v_0 = -(max v + min v)/2     undistorted up to U_s/sqrt 3, the maximum
//
// v_k: phase voltages, U_s: bus voltage, d_k: duties. v_0 shifts all three pole voltages alike, which does
// not change the phase voltages. With pulses in the middle of the period, v_0 = -(max v + min v)/2 results in
// symmetric space-vector modulation: both zero vectors have the same duration. In fixed point, v_k and U_s
// have the same base.
#pragma once
#include "sixstep/control/frames.hpp"
#include "sixstep/control/leg_command.hpp"

namespace sixstep::control {

namespace detail {

/// Command of one leg. Without a bus voltage the duty is 1/2 for all legs, so that the phase voltages are 0.
template <class Scalar>
constexpr LegCommand<Scalar> voltage_leg(Scalar v, Scalar bus_V) {
  constexpr auto half = static_cast<Scalar>(0.5);
  const Scalar duty = bus_V > Scalar{} ? between(half + v / bus_V, Scalar{}, one<Scalar>) : half;
  return {LegState::pwm, PwmSwitches::complementary, duty};
}

}  // namespace detail

/// v_k - (max v + min v)/2. It is computed as the mean of v_k - max v and v_k - min v, which fits every
/// format.
template <class Scalar>
constexpr Abc<Scalar> centred(const Abc<Scalar>& v) {
  const Scalar high = v.a > v.b ? (v.a > v.c ? v.a : v.c) : (v.b > v.c ? v.b : v.c);
  const Scalar low = v.a < v.b ? (v.a < v.c ? v.a : v.c) : (v.b < v.c ? v.b : v.c);
  const auto from_the_middle = [&](Scalar x) {
    return ScalarTraits<Scalar>::half_difference(x, high) + ScalarTraits<Scalar>::half_difference(x, low);
  };
  return {from_the_middle(v.a), from_the_middle(v.b), from_the_middle(v.c)};
}

/// Sine-triangle modulation of the phase voltages, V. Each leg is computed independently.
template <class Scalar>
constexpr LegCommands<Scalar> sine_triangle(const Abc<Scalar>& voltage_V, Scalar bus_V) {
  return {.enabled = true,
          .leg = {detail::voltage_leg(voltage_V.a, bus_V), detail::voltage_leg(voltage_V.b, bus_V),
                  detail::voltage_leg(voltage_V.c, bus_V)}};
}

template <class Scalar>
constexpr LegCommands<Scalar> space_vector(const Abc<Scalar>& voltage_V, Scalar bus_V) {
  return sine_triangle(centred(voltage_V), bus_V);
}

}  // namespace sixstep::control
