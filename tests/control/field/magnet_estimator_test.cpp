// SPDX-License-Identifier: Apache-2.0
// The estimators of the magnet's direction are compared with their equations. The plants are a winding of L_d
// and L_q with voltage pulses, saturating iron, and the flux of a rotating magnet.
#include "sixstep/control/field/magnet_estimator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

template <class Scalar>
class MagnetEstimator : public ::testing::Test {};
using Floating = ::testing::Types<double, float>;
TYPED_TEST_SUITE(MagnetEstimator, Floating);

template <class Scalar>
double digits(double size) {
  return 16 * size * static_cast<double>(std::numeric_limits<Scalar>::epsilon());
}

template <class Scalar>
Direction<Scalar> along(double rad) {
  return {static_cast<Scalar>(std::cos(rad)), static_cast<Scalar>(std::sin(rad))};
}

constexpr double L_d = 0.24e-3, L_q = 0.34e-3, T = 50e-6, V = 3.0;
constexpr double Y_S = (1 / L_d + 1 / L_q) / 2, Y_D = (1 / L_d - 1 / L_q) / 2;

/// Change of the current over a period. The voltage v has the direction `at`, the magnet has the direction
/// `magnet`, and R = 0.
AlphaBeta<double> change(double v, double at, double magnet) {
  const double d = v * std::cos(at - magnet), q = v * std::sin(at - magnet);
  const double i_d = d * T / L_d, i_q = q * T / L_q;
  return {i_d * std::cos(magnet) - i_q * std::sin(magnet), i_d * std::sin(magnet) + i_q * std::cos(magnet)};
}

/// The response h after ten periods of injection. The voltage acts `late` periods later. A parabola over time
/// is added to the measured current.
template <class Scalar>
Dq<Scalar> pulsed(double axis, double magnet, std::uint8_t late, double parabola_A) {
  const InjectionConfig<Scalar> c{static_cast<Scalar>(V), Scalar(1)};
  InjectionState<Scalar> state;
  AlphaBeta<double> i{};
  double answers[3]{};
  Dq<Scalar> h{};
  for (int n = 0; n < 10; ++n) {
    const AlphaBeta<Scalar> sample{static_cast<Scalar>(i.alpha + parabola_A * n * n),
                                   static_cast<Scalar>(i.beta - parabola_A * n * (n - 3))};
    h = injection_response(state, sample, late);
    for (int k = 2; k > 0; --k) answers[k] = answers[k - 1];
    answers[0] = static_cast<double>(injected_voltage(c, state, along<Scalar>(axis), true));
    const AlphaBeta<double> by = change(answers[late], axis, magnet);
    i = {i.alpha + by.alpha, i.beta + by.beta};
  }
  return h;
}

TYPED_TEST(MagnetEstimator, APulseShowsTheAxisAsTheEquationsSay) {
  for (std::uint8_t late = 0; late < 3; ++late)
    for (double e = -1.5; e < 1.5; e += 0.25) {
      const Dq<TypeParam> h = pulsed<TypeParam>(0.4, 0.4 + e, late, 0.0);
      EXPECT_NEAR(h.d, V * T * (Y_S + Y_D * std::cos(2 * e)), digits<TypeParam>(1)) << late << ", " << e;
      EXPECT_NEAR(h.q, V * T * Y_D * std::sin(2 * e), digits<TypeParam>(1)) << late << ", " << e;
    }
}

TYPED_TEST(MagnetEstimator, ACurrentAlongAParabolaIsNotSeenInThePulse) {
  const Dq<TypeParam> still = pulsed<TypeParam>(0.4, 0.6, 1, 0.0), runs = pulsed<TypeParam>(0.4, 0.6, 1, 0.1);
  EXPECT_NEAR(still.d, runs.d, digits<TypeParam>(10));
  EXPECT_NEAR(still.q, runs.q, digits<TypeParam>(10));
}

TYPED_TEST(MagnetEstimator, WithoutThreePulsesNothingIsToldOfThem) {
  InjectionState<TypeParam> state;
  for (int n = 0; n < 3; ++n) {
    const Dq<TypeParam> h =
        injection_response(state, AlphaBeta<TypeParam>{TypeParam(n % 2), TypeParam(-n)}, std::uint8_t{0});
    EXPECT_EQ(h, Dq<TypeParam>{}) << n;
    injected_voltage(InjectionConfig<TypeParam>{TypeParam(1), TypeParam(1)}, state, {}, true);
  }
}

template <class Scalar>
NorthState<Scalar> looked(double saturation, double current_A) {
  const PolarityConfig<Scalar> c{static_cast<Scalar>(current_A), static_cast<Scalar>(current_A / 40.0 / 3), 5,
                                 8};
  NorthState<Scalar> state;
  for (int n = 0; n < 100; ++n) {
    const double i_d = static_cast<double>(north_current(c, state)) * saturation;
    // In the first periods, the block settles and must ignore h. The test therefore gives a wrong h.
    const double h = state.ticks < 5 ? 100.0 : V * T / (L_d * (1 - i_d / 40.0));
    north_step(c, state, static_cast<Scalar>(h));
  }
  return state;
}

/// The ratio (h+ - h-)/(h+ + h-) of the responses with current along and against the axis is equal to I/I_sat
/// to the last digit. The sign of the ratio reverses with the frame.
TYPED_TEST(MagnetEstimator, SaturationTellsNorth) {
  for (const double I : {2.0, 8.0}) {
    const NorthState<TypeParam> found = looked<TypeParam>(1, I), opposite = looked<TypeParam>(-1, I);
    EXPECT_EQ(found.phase, NorthPhase::found);
    EXPECT_EQ(opposite.phase, NorthPhase::opposite);
    EXPECT_NEAR(north_seen(found), I / 40.0, digits<TypeParam>(4));
    EXPECT_NEAR(north_seen(opposite), -I / 40.0, digits<TypeParam>(4));
    EXPECT_EQ(north_current(PolarityConfig<TypeParam>{TypeParam(I), {}, 5, 8}, found), TypeParam{});
  }
  EXPECT_EQ(looked<TypeParam>(0, 8.0).phase, NorthPhase::unseen);
  EXPECT_EQ(looked<TypeParam>(0.3, 8.0).phase, NorthPhase::unseen);
}

/// A magnet that turns by 0.05 rad per period, with currents along both axes. The voltage u is computed by
/// the trapezoidal rule: it is the voltage that the resistance R, these currents and the flux require.
template <class Scalar>
struct Turning {
  double R = 0.5, psi = 2e-3, i_d = -1.0, i_q = 3.0, angle = 0.3;
  double flux_alpha = 0, flux_beta = 0, a = 0, b = 0;

  ActiveFluxConfig<Scalar> config(double pull) const {
    const auto s = [](double x) { return static_cast<Scalar>(x); };
    return {s(T), s(R), s(L_q), s(L_d - L_q), s(psi), s(pull)};
  }
  void put() {
    const double c = std::cos(angle), s = std::sin(angle), d = L_d * i_d + psi, q = L_q * i_q;
    flux_alpha = d * c - q * s;
    flux_beta = d * s + q * c;
    a = i_d * c - i_q * s;
    b = i_d * s + i_q * c;
  }
  /// Advances by one period and returns the mean voltage of this period.
  AlphaBeta<Scalar> period() {
    const Turning before = *this;
    angle += 0.05;
    put();
    return {static_cast<Scalar>((flux_alpha - before.flux_alpha) / T + R * (a + before.a) / 2),
            static_cast<Scalar>((flux_beta - before.flux_beta) / T + R * (b + before.b) / 2)};
  }
};

TYPED_TEST(MagnetEstimator, TheActiveFluxPointsAlongTheMagnet) {
  Turning<TypeParam> m;
  m.put();
  const ActiveFluxConfig<TypeParam> c = m.config(0.0);
  ActiveFluxState<TypeParam> state{
      .flux = {static_cast<TypeParam>(m.flux_alpha), static_cast<TypeParam>(m.flux_beta)},
      .current = {static_cast<TypeParam>(m.a), static_cast<TypeParam>(m.b)}};
  for (int n = 0; n < 200; ++n) {
    const AlphaBeta<TypeParam> u = m.period();
    const TypeParam ahead =
        active_flux_step(c, state, u, {static_cast<TypeParam>(m.a), static_cast<TypeParam>(m.b)},
                         along<TypeParam>(m.angle - 0.01));
    EXPECT_NEAR(ahead, std::sin(0.01) / (std::sin(0.01) + std::cos(0.01)), 2000 * digits<TypeParam>(1));
    EXPECT_NEAR(state.along, (m.psi + (L_d - L_q) * m.i_d) * std::cos(0.01), 4 * digits<TypeParam>(1));
  }
}

/// In the magnet's frame, an error of the flux decays by the factor 1 - g in each period.
TYPED_TEST(MagnetEstimator, AnOffsetOfTheFluxFades) {
  Turning<TypeParam> m;
  m.put();
  constexpr double g = 0.02, off = 1e-3;
  const ActiveFluxConfig<TypeParam> c = m.config(g);
  ActiveFluxState<TypeParam> state{
      .flux = {static_cast<TypeParam>(m.flux_alpha + off), static_cast<TypeParam>(m.flux_beta)},
      .current = {static_cast<TypeParam>(m.a), static_cast<TypeParam>(m.b)}};
  for (int n = 1; n <= 100; ++n) {
    const AlphaBeta<TypeParam> u = m.period();
    active_flux_step(c, state, u, {static_cast<TypeParam>(m.a), static_cast<TypeParam>(m.b)},
                     along<TypeParam>(m.angle));
    EXPECT_NEAR(state.flux.alpha - m.flux_alpha, off * std::pow(1 - g, n), 8 * digits<TypeParam>(1)) << n;
    EXPECT_NEAR(state.flux.beta - m.flux_beta, 0.0, 8 * digits<TypeParam>(1));
  }
}

TYPED_TEST(MagnetEstimator, BehindTheMagnetTheWayBackIsShown) {
  Turning<TypeParam> m;
  m.put();
  for (const double e : {2.0, 3.0, -2.0, -3.0}) {
    ActiveFluxState<TypeParam> state{
        .flux = {static_cast<TypeParam>(m.flux_alpha), static_cast<TypeParam>(m.flux_beta)},
        .current = {static_cast<TypeParam>(m.a), static_cast<TypeParam>(m.b)}};
    const TypeParam R = static_cast<TypeParam>(m.R);
    const TypeParam ahead =
        active_flux_step(m.config(0.0), state, {R * state.current.alpha, R * state.current.beta},
                         state.current, along<TypeParam>(m.angle - e));
    EXPECT_EQ(ahead, TypeParam(e > 0 ? 1 : -1)) << e;
  }
}

/// Below w_low, the estimate is computed from injection; above w_high, from the flux. Between these speeds,
/// both are blended linearly. If only one of the two estimates exists, it is used alone.
TYPED_TEST(MagnetEstimator, SpeedSaysWhichOneIsFollowed) {
  EstimatorConfig<TypeParam> c{};
  c.injection.voltage_V = TypeParam(1);
  EXPECT_EQ(detail::flux_weight(c, TypeParam(100)), TypeParam(0));
  c.flux.magnet_Vs = TypeParam(1e-3);
  c.low_rad_s = TypeParam(20);
  c.high_rad_s = TypeParam(40);
  for (const double w : {-50.0, -40.0, -25.0, 0.0, 20.0, 30.0, 40.0, 100.0}) {
    const double m = std::fmin(1.0, std::fmax(0.0, (std::fabs(w) - 20) / 20));
    EXPECT_NEAR(detail::flux_weight(c, static_cast<TypeParam>(w)), m, digits<TypeParam>(1)) << w;
  }
  c.injection.voltage_V = TypeParam(0);
  EXPECT_EQ(detail::flux_weight(c, TypeParam(0)), TypeParam(1));
}

}  // namespace SIXSTEP_TEST_FILE
