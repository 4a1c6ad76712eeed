// SPDX-License-Identifier: Apache-2.0
// Controls the currents without a modulator. With three legs, each high or low for a whole period, seven
// different voltages are possible. The controller applies the voltage that brings the current nearest to the
// reference (Rodriguez et al., Predictive current control of a voltage source inverter, IEEE Trans. IE 54,
// 2007).
//
// If the output acts one period late, the controller first predicts the current at the begin of that period,
// from the voltage that acts until then (Cortes et al., Delay compensation in model predictive current
// control of a three-phase inverter, IEEE Trans. IE 59, 2012).
//
// The voltage is constant in the stator's frame while the magnet turns by x = w_e T. The computation uses a
// frame at rest: the magnet's frame in the middle of the period. In this frame the winding has R, L and the
// coupling voltage of the rotation (field_current.hpp):
//
//   L_d di_d/dt = v_d - R i_d - w_e (L_d - L_q) i_q - e_d
//   L_q di_q/dt = v_q - R i_q - w_e (L_d - L_q) i_d - e_q      e = (0, w p psi), or harmonic_current.hpp
//   per axis: i' = a i + b (v - ...),   a = exp(-R T/L), b = (1 - a)/R
//
// i is rotated back by x/2, advanced by a period, and rotated back by x/2 again. For a round rotor this is
// exact except for e. During the period e rotates by +-x/2 about its mean, which causes an error of x^2/24 of
// e. The controller chooses the state of least cost among the eight:
//
//   J = |i* - i'|^2 + s^2 (number of legs that change)
//
// i* is the reference, i' the current one period later. s is the current error, in A, whose cost equals that
// of one switching leg. A state whose current exceeds the bound `most_A` is worse than every state within the
// bound. Among states beyond the bound, the state with the least current is best. Among states of equal cost,
// the state that changes fewer legs is chosen. This rule selects one of the two zero vectors.
//
// A leg switches at most once per period, with a frequency that varies up to 1/(2 T). If the bus voltage U
// suffices, i' is within 2/(3 sqrt 3) b U of i*. This is the circumradius of the triangles between the seven
// possible currents. The controller has no integral. Errors of the model, such as dead time and a diode's
// drop, therefore cause an error of the mean current.
//
// This control exists in floating point only, because its scaling is not proved.
#pragma once
#include "sixstep/control/field/field_current.hpp"
#include "sixstep/control/leg_command.hpp"
#include "sixstep/control/sensing/binary_angle.hpp"
#include "sixstep/control/sensing/sine.hpp"

namespace sixstep::control {

/// Default: off.
template <class Scalar>
struct FiniteSetConfig {
  bool on = false;
  bool foretells = false;                 ///< true: outputs act a period late, and this delay is compensated
  Gain<Scalar> d_decay{}, q_decay{};      ///< a, decay of the current over a period
  Gain<Scalar> d_A_per_V{}, q_A_per_V{};  ///< b, change of the current per volt over a period
  /// p T/2: electrical rad of half the rotation x/2 per mechanical rad/s; the product is clamped to 1 rad.
  Gain<Scalar> half_turn_s{};
  Gain<Scalar> salient_V_s_A{};  ///< p (L_d - L_q)
  Scalar switching_A{};          ///< s, current error that weighs as much as one switching leg
  Scalar most_A{};               ///< bound of |i'|; 0: no bound
  bool operator==(const FiniteSetConfig&) const = default;
};

/// Legs as bits: a is bit 0, high is 1.
using LegBits = std::uint8_t;

template <class Scalar>
struct FiniteSetState {
  LegBits legs = 0;       ///< legs of the last output
  Dq<Scalar> foretold{};  ///< predicted current at the end of the commanded period, in the magnet's frame at
                          ///< this end
};

/// Inputs of a tick. `e` is the back-EMF of the period that has begun, `e_next` that of the commanded period.
/// Each is the back-EMF at the magnet's direction in the middle of the period.
template <class Scalar>
struct FiniteSetInput {
  Dq<Scalar> reference{}, measured{};
  Direction<Scalar> magnet{};  ///< direction at the sample
  Scalar speed_rad_s{}, bus_V{};
  Dq<Scalar> e{}, e_next{};
};

/// The phase voltages of three legs as a vector, V. The voltage of phase a relative to the star point is U (2
/// a - b - c)/3. a, b, c are 1 for a high leg and 0 for a low leg, and U is the bus voltage.
template <class Scalar>
constexpr AlphaBeta<Scalar> legs_voltage(LegBits legs, Scalar bus_V) {
  const auto side = [&](unsigned k) { return (legs >> k & 1u) != 0 ? bus_V : Scalar{}; };
  return clarke(Abc<Scalar>{side(0), side(1), side(2)});
}

constexpr std::uint8_t legs_changed(LegBits from, LegBits to) {
  const auto x = static_cast<unsigned>(from ^ to);
  return static_cast<std::uint8_t>((x & 1u) + (x >> 1 & 1u) + (x >> 2 & 1u));
}

template <class Scalar>
constexpr LegCommands<Scalar> as_legs(LegBits legs) {
  const auto leg = [legs](unsigned k) {
    return LegCommand<Scalar>{(legs >> k & 1u) != 0 ? LegState::high : LegState::low,
                              PwmSwitches::complementary, Scalar{}};
  };
  return {.enabled = true, .leg = {leg(0), leg(1), leg(2)}};
}

namespace detail {

/// The direction `from`, rotated forward by `by`.
template <class Scalar>
constexpr Direction<Scalar> turned(const Direction<Scalar>& from, const Direction<Scalar>& by) {
  return {from.cos * by.cos - from.sin * by.sin, from.sin * by.cos + from.cos * by.sin};
}

/// The vector x in a frame that is rotated forward by `by`.
template <class Scalar>
constexpr Dq<Scalar> seen_from(const Dq<Scalar>& x, const Direction<Scalar>& by) {
  return {x.d * by.cos + x.q * by.sin, x.q * by.cos - x.d * by.sin};
}

/// i' for a voltage of 0, in the magnet's frame in the middle of the period, A.
template <class Scalar>
constexpr Dq<Scalar> left_alone(const FiniteSetConfig<Scalar>& config, const Dq<Scalar>& i,
                                Scalar speed_rad_s, const Dq<Scalar>& e) {
  using T = ScalarTraits<Scalar>;
  const Scalar x_d = T::product(speed_rad_s * i.q, config.salient_V_s_A) + e.d;
  const Scalar x_q = T::product(speed_rad_s * i.d, config.salient_V_s_A) + e.q;
  return {T::product(i.d, config.d_decay) - T::product(x_d, config.d_A_per_V),
          T::product(i.q, config.q_decay) - T::product(x_q, config.q_A_per_V)};
}

/// Change of i', A, that a voltage v in the same frame causes.
template <class Scalar>
constexpr Dq<Scalar> driven_by(const FiniteSetConfig<Scalar>& config, const Dq<Scalar>& v) {
  using T = ScalarTraits<Scalar>;
  return {T::product(v.d, config.d_A_per_V), T::product(v.q, config.q_A_per_V)};
}

template <class Scalar>
constexpr Scalar square(const Dq<Scalar>& x) {
  return x.d * x.d + x.q * x.q;
}

/// Rating of a state. The members are compared in this order: the current beyond the bound, the cost, the
/// number of legs that change.
template <class Scalar>
struct Judged {
  Scalar beyond{}, cost{};
  std::uint8_t changed = 0;
};

template <class Scalar>
constexpr bool better(const Judged<Scalar>& a, const Judged<Scalar>& b) {
  if (a.beyond != b.beyond) return a.beyond < b.beyond;
  if (a.cost != b.cost) return a.cost < b.cost;
  return a.changed < b.changed;
}

template <class Scalar>
constexpr Judged<Scalar> judged(const FiniteSetConfig<Scalar>& config, const Dq<Scalar>& i,
                                const Dq<Scalar>& reference, std::uint8_t changed) {
  const Scalar over = square(i) - config.most_A * config.most_A;
  const Dq<Scalar> off{reference.d - i.d, reference.q - i.q};
  Scalar cost = square(off);
  for (std::uint8_t n = 0; n < changed; ++n) cost = cost + config.switching_A * config.switching_A;
  return {config.most_A > Scalar{} && over > Scalar{} ? over : Scalar{}, cost, changed};
}

}  // namespace detail

/// The current one period later, A, if the legs do not switch meanwhile. `middle`: the magnet's direction in
/// the middle of the period. `half`: the magnet's rotation in half a period.
template <class Scalar>
constexpr Dq<Scalar> foretold(const FiniteSetConfig<Scalar>& config, const Dq<Scalar>& i,
                              const AlphaBeta<Scalar>& voltage_V, const Direction<Scalar>& middle,
                              const Direction<Scalar>& half, Scalar speed_rad_s, const Dq<Scalar>& e) {
  const Dq<Scalar> alone = detail::left_alone(config, detail::seen_from(i, half), speed_rad_s, e);
  const Dq<Scalar> more = detail::driven_by(config, park(voltage_V, middle));
  return detail::seen_from(Dq<Scalar>{alone.d + more.d, alone.q + more.q}, half);
}

/// One control tick: returns the legs of the next period, which are also stored in state.legs.
template <class Scalar>
constexpr LegBits finite_set_step(const FiniteSetConfig<Scalar>& config, FiniteSetState<Scalar>& state,
                                  const FiniteSetInput<Scalar>& in) {
  const std::int32_t x = angle_of_rad(ScalarTraits<Scalar>::product(in.speed_rad_s, config.half_turn_s));
  const auto half = direction_of<Scalar>(static_cast<BinaryAngle>(x));
  Direction<Scalar> middle = detail::turned(in.magnet, half);
  Dq<Scalar> i = in.measured;
  if (config.foretells) {
    i = foretold(config, i, legs_voltage(state.legs, in.bus_V), middle, half, in.speed_rad_s, in.e);
    middle = detail::turned(detail::turned(middle, half), half);
  }
  // Rotating the reference back once replaces rotating all eight currents forward.
  const Dq<Scalar> alone = detail::left_alone(config, detail::seen_from(i, half), in.speed_rad_s, in.e_next);
  const Direction<Scalar> back{half.cos, -half.sin};
  const Dq<Scalar> reference = detail::seen_from(in.reference, back);
  detail::Judged<Scalar> best{};
  LegBits legs = 0;
  Dq<Scalar> there{};
  for (LegBits n = 0; n < 8; ++n) {
    const Dq<Scalar> more = detail::driven_by(config, park(legs_voltage(n, in.bus_V), middle));
    const Dq<Scalar> then{alone.d + more.d, alone.q + more.q};
    const auto own = detail::judged(config, then, reference, legs_changed(state.legs, n));
    if (n != 0 && !detail::better(own, best)) continue;
    best = own;
    legs = n;
    there = then;
  }
  state.foretold = detail::seen_from(there, half);
  state.legs = legs;
  return legs;
}

}  // namespace sixstep::control
