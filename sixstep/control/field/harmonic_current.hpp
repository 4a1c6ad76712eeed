// SPDX-License-Identifier: Apache-2.0
// Computes currents for a back-EMF that is not sinusoidal: the torque is the same at every angle, with the
// least copper loss. In the magnet's frame the back-EMFs of the three phases are a vector w p psi g(theta).
// w: mechanical speed, p: pole pairs, psi: flux linkage, g: shape vector. For a sinusoidal back-EMF g = (0,
// 1). For other shapes the direction and length of g vary with the sixth harmonic and its multiples. The
// torque is
//
//   T = 3/2 p psi (g_d i_d + g_q i_q)
//
// With a constant i_q the torque is proportional to g_q. Among the current vectors with T = 3/2 p psi I at an
// angle, the shortest vector has the direction of g (Hung and Ding, Design of currents to reduce torque
// ripple in brushless permanent magnet motors, IEE Proc. B 140, 1993):
//
//   i* = I g/|g|^2
//
// The star point is not connected and carries no current. A part of the back-EMF that is common to the three
// phases therefore causes no torque and no loss, and g does not contain it. The component along g of a
// current i_w that weakens the field would cause torque. Therefore only its component across g is used, (i_w
// g_q/|g|^2) (g_q, -g_d). The sum of i* and this component is within I_max if |I| <= min|g| sqrt(I_max^2 -
// i_w^2).
//
// If phases and half waves are alike, g has a period of 60 electrical degrees. g is stored as a table of 32
// points and interpolated linearly. The corners of a trapezoid of 120 degrees are points of the table, and
// curved parts have an error of at most 1.6e-4. The error of a Fourier series falls only with the square of
// the order. With 32 coefficients it is 0.7 % at the corners, and the series needs four times as many
// products.
//
// A loop without feed-forward lags. If the loop decouples the axes, the sixth harmonic of the current is fed
// forward with the coupling. In addition to w p psi g, the voltage v is fed forward. v changes the current,
// during the output's period, from i* at the begin to i* at the end of the period:
//
//   v = L (i*(theta' + x/2) - i*(theta' - x/2))/T + R (i*(theta') - (i_w, I)),   x = w_e T
//
// theta' is the magnet's angle in the middle of the period, T the period, w_e the electrical speed. The loop
// then corrects only the errors of the model, as long as the voltage suffices. If the loop does not decouple
// the axes, i* is computed for a later angle of the magnet: its angle when the current has followed. Let r be
// 6 w_e divided by the loop's bandwidth. The remaining lag then has no part proportional to r and grows with
// r^2.
//
// This control exists in floating point only, because its scaling is not proved.
#pragma once
#include "sixstep/control/field/field_current.hpp"
#include "sixstep/control/field/field_direction.hpp"

namespace sixstep::control {

inline constexpr std::uint8_t shape_points = 32;

/// Default: the current for a sinusoidal back-EMF, i_q only.
template <class Scalar>
struct HarmonicCurrentConfig {
  bool on = false;
  /// Electrical rad that the magnet turns until the current has followed, per mechanical rad/s, for a loop
  /// without feed-forward; the product is clamped to 1 rad.
  Gain<Scalar> lead_rad_s{};
  Gain<Scalar> half_turn_s{};        ///< p T/2: electrical rad of x/2 per mechanical rad/s; clamped to 1 rad
  Gain<Scalar> slope_V_A{};          ///< L/T, voltage per ampere of change in a period
  Gain<Scalar> R_ohm{};              ///< resistance of a phase
  Scalar least{};                    ///< min |g|, least length of the shape vector
  Dq<Scalar> shape[shape_points]{};  ///< g, with the magnet at n/32 of 60 electrical degrees
  bool operator==(const HarmonicCurrentConfig&) const = default;
};

/// g at an angle of the magnet.
template <class Scalar>
constexpr Dq<Scalar> shape_at(const HarmonicCurrentConfig<Scalar>& config, BinaryAngle magnet) {
  const auto in_sixth = static_cast<BinaryAngle>(magnet * 6u);  // wraps after 60 electrical degrees, the
                                                                // period of the shape
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

/// i*, A, for a torque current I and a current `weakening` along the magnet that weakens its field.
template <class Scalar>
constexpr Dq<Scalar> harmonic_current(const HarmonicCurrentConfig<Scalar>& config, BinaryAngle magnet,
                                      Scalar speed_rad_s, Scalar I, Scalar weakening) {
  return detail::current_along(shape_at(config, turned_on(magnet, speed_rad_s, config.lead_rad_s)), I,
                               weakening);
}

/// i*, A, in the middle of a period, and the voltage, V, that changes the current from i* at its begin to i*
/// at its end. `magnet` is the magnet's angle in the middle of the period.
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

/// w p psi g, V: the back-EMF along the magnet's axis and across. For a sinusoidal back-EMF it is (0, w p
/// psi).
template <class Scalar>
constexpr Dq<Scalar> harmonic_voltage(const HarmonicCurrentConfig<Scalar>& config, BinaryAngle magnet,
                                      Scalar speed_rad_s, Gain<Scalar> magnet_V_s) {
  const Dq<Scalar> g = shape_at(config, magnet);
  const Scalar V = ScalarTraits<Scalar>::product(speed_rad_s, magnet_V_s);
  return {V * g.d, V * g.q};
}

}  // namespace sixstep::control
