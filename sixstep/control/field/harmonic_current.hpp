// SPDX-License-Identifier: Apache-2.0
// Currents for a back-EMF that is no sine: the same torque at every angle, with the least copper loss. In the frame of the
// magnet the three phases' back-EMFs are a vector w p psi g(theta), g = (0, 1) of a sine; of any other shape g turns and swings,
// by the sixth harmonic and its multiples, and
//
//   T = 3/2 p psi (g_d i_d + g_q i_q)
//
// A constant i_q makes a torque that swings as g_q does. Of all currents that make T = 3/2 p psi I at an angle the shortest lies
// along g (Hung and Ding, Design of currents to reduce torque ripple in brushless permanent magnet motors, IEE Proc. B 140, 1993),
//
//   i* = I g/|g|^2
//
// A star point that is not brought out carries no current, so that what the three phases have in common makes no torque and no
// loss: it drops out of g. What weakens the field would make torque along g; of that current the part across g is asked for,
// (i_w g_q/|g|^2) (g_q, -g_d), which makes none. Both together stay within I_max where |I| <= min|g| sqrt(I_max^2 - i_w^2).
//
// Phases alike and half waves alike give g a period of 60 electrical degrees. It is a table of 32 points, straight between them:
// the corners of a trapezoid of 120 degrees are points of it, and its bows are met to 1.6e-4. As a Fourier series they
// would fall with the square of the order: 32 numbers of it leave 0.7 % at the corners, for four times the products.
//
// A loop alone follows late. Where it decouples the axes, what the sixth harmonic asks for is fed forward with what turning makes:
// beside w p psi g the voltage that takes the current along in the period that is answered, from i* at its beginning to i* at its
// end, and i* itself is that of the sample's angle, as the measured current is,
//
//   v = L (i*(theta' + x/2) - i*(theta' - x/2))/T + R (i*(theta') - (i_w, I)),   x = w_e T
//
// Nothing is left to the loop then but what the model is off by, as long as the voltage is there. Where it does not, i* is that of
// the angle to which the magnet has turned until the loop is there: to the first order of 6 w_e over the loop's bandwidth nothing
// lags, and what is left grows with its square.
//
// In floating point only: no scaling of it is proved.
#pragma once
#include "sixstep/control/field/field_current.hpp"
#include "sixstep/control/field/field_direction.hpp"

namespace sixstep::control {

inline constexpr std::uint8_t shape_points = 32;

/// The default is that of a sine: i_q alone.
template <class Scalar>
struct HarmonicCurrentConfig {
  bool on = false;
  /// Electrical rad per mechanical rad/s that the magnet turns until the current is there, where it is not fed forward; more than
  /// 1 rad is cut off.
  Gain<Scalar> lead_rad_s{};
  Gain<Scalar> half_turn_s{};        ///< p T/2: electrical rad of x/2 per mechanical rad/s, likewise
  Gain<Scalar> slope_V_A{};          ///< L/T
  Gain<Scalar> R_ohm{};              ///< of a phase
  Scalar least{};                    ///< min |g|
  Dq<Scalar> shape[shape_points]{};  ///< g where the magnet stands n/32 of 60 degrees on
  bool operator==(const HarmonicCurrentConfig&) const = default;
};

/// g, where the magnet points so.
template <class Scalar>
constexpr Dq<Scalar> shape_at(const HarmonicCurrentConfig<Scalar>& config, BinaryAngle magnet) {
  const auto in_sixth = static_cast<BinaryAngle>(magnet * 6u);  // wraps where the shape does
  const auto n = static_cast<std::uint8_t>(in_sixth >> 27);
  const auto rest = static_cast<std::int32_t>((in_sixth << 5) >> 1);
  const Scalar part = AngleTraits<Scalar>::half_turns(rest);
  const Dq<Scalar>&a = config.shape[n], &b = config.shape[(n + 1u) % shape_points];
  return {a.d + (b.d - a.d) * part, a.q + (b.q - a.q) * part};
}

namespace detail {

template <class Scalar>
constexpr Dq<Scalar> current_along(const Dq<Scalar>& g, Scalar I, Scalar weakening) {
  const Scalar square = g.d * g.d + g.q * g.q;
  const Scalar along = I / square, across = weakening * g.q / square;
  return {along * g.d + across * g.q, along * g.q - across * g.d};
}

}  // namespace detail

/// i*, of I and of a current along the magnet that weakens its field.
template <class Scalar>
constexpr Dq<Scalar> harmonic_current(const HarmonicCurrentConfig<Scalar>& config, BinaryAngle magnet,
                                      Scalar speed_rad_s, Scalar I, Scalar weakening) {
  return detail::current_along(shape_at(config, turned_on(magnet, speed_rad_s, config.lead_rad_s)), I,
                               weakening);
}

/// i* in a period in whose middle the magnet points so, and the voltage that takes it along.
template <class Scalar>
struct TakenAlong {
  Dq<Scalar> current{}, voltage{};
};
template <class Scalar>
constexpr TakenAlong<Scalar> taken_along(const HarmonicCurrentConfig<Scalar>& config, BinaryAngle magnet,
                                         Scalar speed_rad_s, Scalar I, Scalar weakening) {
  using T = ScalarTraits<Scalar>;
  constexpr auto half = static_cast<Scalar>(0.5);
  const auto at = [&](BinaryAngle angle) {
    return detail::current_along(shape_at(config, angle), I, weakening);
  };
  const BinaryAngle on = turned_on(BinaryAngle{0}, speed_rad_s, config.half_turn_s);
  const Dq<Scalar> begin = at(magnet - on), end = at(magnet + on);
  const Dq<Scalar> middle{half * (begin.d + end.d), half * (begin.q + end.q)};
  return {middle,
          {T::product(end.d - begin.d, config.slope_V_A) + T::product(middle.d - weakening, config.R_ohm),
           T::product(end.q - begin.q, config.slope_V_A) + T::product(middle.q - I, config.R_ohm)}};
}

/// w p psi g: what the magnet makes along itself and across, in place of (0, w p psi).
template <class Scalar>
constexpr Dq<Scalar> harmonic_voltage(const HarmonicCurrentConfig<Scalar>& config, BinaryAngle magnet,
                                      Scalar speed_rad_s, Gain<Scalar> magnet_V_s) {
  const Dq<Scalar> g = shape_at(config, magnet);
  const Scalar V = ScalarTraits<Scalar>::product(speed_rad_s, magnet_V_s);
  return {V * g.d, V * g.q};
}

}  // namespace sixstep::control
