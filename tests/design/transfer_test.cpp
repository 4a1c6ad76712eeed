// SPDX-License-Identifier: Apache-2.0
// Sampled systems are compared with closed forms of first and second order. Stability is compared with known
// roots.
#include "sixstep/design/loops/transfer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sixstep/design/loops/loop_figures.hpp"
#include "sixstep/design/loops/pole_placement.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::design;

constexpr double eps = 0x1p-52;
constexpr double period_s = 30e-6;

TEST(Sampled, FirstOrderIsTheZohPlant) {
  for (const double R : {0.01, 1.03, 50.0}) {
    Linear rl{.states = 1, .A = {}, .B = {}};
    rl.A[0][0] = -R / 0.572e-3;
    rl.B[0] = 1.0 / 0.572e-3;
    const Transfer t = sampled(rl, 0, period_s);
    const ZohPlant exact = current_plant(R, 0.572e-3, period_s);
    // The difference has two causes: the rounding of the exponent, which is eps times R T/L (up to 2.6), and
    // the rounding of a dozen terms.
    EXPECT_NEAR(t.den[0] / (1.0 + exact.a0), 1.0, 16 * eps + 2 * eps / (1.0 + exact.a0));
    EXPECT_NEAR(t.num[0] / exact.b0, 1.0, 16 * eps);
  }
}

TEST(Sampled, DoubleIntegratorHasHalfTheSquareOfThePeriod) {
  Linear body{.states = 2, .A = {}, .B = {}};
  body.A[1][0] = 1.0;
  body.B[0] = 1.0;
  const Transfer t = sampled(body, 1, 0.5);  // T^2/2 (delta + 2)/delta^2; all numbers are exact in binary
  EXPECT_EQ(t.num, (Polynomial{0.25, 0.125}));
  EXPECT_EQ(t.den, (Polynomial{0.0, 0.0, 1.0}));
}

TEST(Sampled, TheStepResponseOfTwoLagsIsTheExponentials) {
  // The system 1/((s + a)(s + b)) with a hold has the step response 1/(ab) (1 - (b e^-at - a e^-bt)/(b - a)).
  const double a = 300.0, b = 1800.0, T = 1e-4;
  Linear lags{.states = 2, .A = {}, .B = {}};
  lags.A[0] = {-b, 0.0, 0.0, 0.0};
  lags.A[1] = {1.0, -a, 0.0, 0.0};
  lags.B[0] = 1.0;
  const Transfer t = sampled(lags, 1, T);
  const StepResponse r = step_response(t, T, 100 * T);
  for (std::size_t k = 0; k <= 100; ++k) {
    const double time = static_cast<double>(k) * T;
    const double exact =
        1.0 / (a * b) * (1.0 - (b * std::exp(-a * time) - a * std::exp(-b * time)) / (b - a));
    EXPECT_NEAR(r.samples[k] * a * b, exact * a * b, 100 * eps) << k;
  }
}

TEST(Stable, IsWhereAllRootsAreInside) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> radius(0.0, 1.4), angle(0.0, 3.14159);
  for (int n = 0; n < 2000; ++n) {
    Polynomial p{1.0};
    double largest = 0.0;
    for (int pair = 0; pair < 3; ++pair) {
      const double r = radius(random), phi = angle(random);
      largest = std::max(largest, r);
      const double re = r * std::cos(phi);  // (z - z1)(z - z2) with z = 1 + delta
      p = product(p, {1.0 - 2.0 * re + r * r, 2.0 - 2.0 * re, 1.0});
    }
    if (std::fabs(largest - 1.0) < 1e-6) continue;
    EXPECT_EQ(is_stable(p), largest < 1.0) << largest;
    // If two pairs of roots are close, half of the digits are lost.
    EXPECT_NEAR(1.0 - slowest_decay(p), largest, 1e-4 * largest);
  }
}

TEST(Stable, TheSlowestDecayIsThatOfTheSlowestRootHoweverSlow) {
  for (const double decay : {0.9375, 0.5, 1e-3, 1e-7, -2.0}) {
    EXPECT_NEAR(slowest_decay({decay, 1.0}), decay, 4 * eps * std::fabs(decay));
    EXPECT_NEAR(slowest_decay({-decay, -1.0}), decay, 4 * eps * std::fabs(decay));
  }
  // The four roots are about 1e-5 from z = 1. In powers of z, the product of these distances would be 1e-20
  // of the coefficients.
  const Polynomial slow = product(product({1e-5, 1.0}, {2e-5, 1.0}), product({3e-5, 1.0}, {5e-5, 1.0}));
  EXPECT_TRUE(is_stable(slow));
  EXPECT_NEAR(slowest_decay(slow), 1e-5, 1e-12);
}

TEST(Transfers, CloseAndDelay) {
  const Transfer L = series({{0.5}, {0.125, 1.0}}, delay(1));  // 0.5/((z - 0.875) z)
  EXPECT_EQ(L.den, (Polynomial{0.125, 1.125, 1.0}));
  EXPECT_EQ(closed(L).den, (Polynomial{0.625, 1.125, 1.0}));
  const Complex at = L.at(0.3);
  EXPECT_NEAR(at.size(), 0.5 / std::hypot(std::cos(0.3) - 0.875, std::sin(0.3)), 4 * eps);
}

}  // namespace SIXSTEP_TEST_FILE
