// SPDX-License-Identifier: Apache-2.0
// Computes currents for a back-EMF that is no sine: the torque is the same at every angle, with the least
// copper loss. In the magnet's frame the back-EMFs of the three phases are a vector w p psi g(theta). w:
// mechanical speed, psi: flux linkage. For a sine g = (0, 1). For other shapes the direction and length of g
// vary with the sixth harmonic and its multiples. The torque is
//
//   T = 3/2 p psi (g_d i_d + g_q i_q)
//
// With a constant i_q the torque varies as g_q does. Of the currents with T = 3/2 p psi I at an angle, the
// shortest has the direction of g (Hung and Ding, Design of currents to reduce torque ripple in brushless
// permanent magnet motors, IEE Proc. B 140, 1993):
//
//   i* = I g/|g|^2
//
// The star point is not connected and carries no current. A part of the back-EMF that is common to the three
// phases therefore causes no torque and no loss, and g does not contain it. A current i_w that weakens the
// field would cause torque along g. Therefore only its component across g is used, (i_w g_q/|g|^2) (g_q,
// -g_d), which causes no torque. The sum of both currents is within I_max if |I| <= min|g| sqrt(I_max^2 -
// i_w^2).
//
// If phases and half waves are alike, g has a period of 60 electrical degrees. g is stored as a table of 32
// points with straight lines between them. The corners of a trapezoid of 120 degrees are points of the table,
// and curved parts are exact to 1.6e-4. A Fourier series converges only with the square of the order: 32
// coefficients have an error of 0.7 % at the corners and need four times as many products.
//
// A loop without feed-forward lags. If the loop decouples the axes, the sixth harmonic of the current is fed
// forward with the coupling. Besides w p psi g the fed voltage v changes the current, in the output's period,
// from i* at the begin to i* at the end. i* is the current for the angle at the sample, like the measured
// current:
//
//   v = L (i*(theta' + x/2) - i*(theta' - x/2))/T + R (i*(theta') - (i_w, I)),   x = w_e T
//
// theta' is the magnet's angle in the middle of the period. The loop then corrects only the errors of the
// model, as long as the voltage suffices. If the loop does not decouple the axes, i* is computed for the
// magnet's angle at the later instant at which the current has followed. The lag is then 0 to the first order
// of 6 w_e over the loop's bandwidth, and the rest grows with the square of this ratio.
//
// This control exists in floating point only, because its scaling is not proved.
#pragma once
#include "sixstep/control/field/field_current.hpp"
#include "sixstep/control/field/field_direction.hpp"

namespace sixstep::control {

inline constexpr std::uint8_t shape_points = 32;

/// The default is the current for a sine: only i_q.
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
  const auto in_sixth = static_cast<BinaryAngle>(magnet * 6u);  // overflows where the shape repeats
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

/// i*, A, of a period, and the voltage, V, that changes i* within the period. `magnet` is the magnet's angle
/// in the middle of the period.
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

/// w p psi g, V: the magnet's back-EMF along itself and across. For a sine it is (0, w p psi).
template <class Scalar>
constexpr Dq<Scalar> harmonic_voltage(const HarmonicCurrentConfig<Scalar>& config, BinaryAngle magnet,
                                      Scalar speed_rad_s, Gain<Scalar> magnet_V_s) {
  const Dq<Scalar> g = shape_at(config, magnet);
  const Scalar V = ScalarTraits<Scalar>::product(speed_rad_s, magnet_V_s);
  return {V * g.d, V * g.q};
}

}  // namespace sixstep::control
