// SPDX-License-Identifier: Apache-2.0
// Tests the numbers of the thesis (model.md 13), and the definition: the roots of the closed loop's
// polynomial are the required poles.
#include "sixstep/design/loops/pole_placement.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <string>

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::design;
using Wide = long double;

constexpr double eps = 0x1p-52;
constexpr double period_s = 30e-6;
const ZohPlant current = current_plant(1.03, 0.572e-3, period_s);
const ZohPlant speed = speed_plant(0.78, 1.35e-5, 7.3e-6, period_s);

/// Expects that the value is equal to the printed value, within half a unit of the last printed digit.
void expect_printed(double got, double printed, int decimals) {
  EXPECT_NEAR(got, printed, 0.5001 * std::pow(10.0, -decimals));
}

TEST(PolePlacement, CurrentLoopOfTheThesis) {
  expect_printed(current.a0, -0.9474, 4);
  expect_printed(current.b0, 0.0511, 4);
  const auto p = place_poles(current, 1e-3, 0.9, period_s);
  ASSERT_TRUE(p);
  expect_printed(p->z_re, 0.869154, 6);
  expect_printed(p->z_im, 0.058178, 6);
  expect_printed(p->gains.d1, 4.0956, 4);
  expect_printed(p->gains.d0, -3.6940, 4);
  expect_printed(p->gains.d1 + p->gains.d0, 0.4016, 4);
}

TEST(PolePlacement, SpeedLoopOfTheThesis) {
  expect_printed(speed.a0, -0.99998, 5);
  expect_printed(speed.b0, 1.733, 3);
  const auto p = place_poles(speed, 10e-3, 0.9, period_s);
  ASSERT_TRUE(p);
  expect_printed(p->z_re, 0.986273, 6);
  expect_printed(p->z_im, 0.006592, 6);
  expect_printed(p->gains.d1, 0.0158299, 7);
  expect_printed(p->gains.d0, -0.0156961, 7);
  expect_printed(p->gains.d1 + p->gains.d0, 0.00013378, 8);
}

TEST(PolePlacement, ThesisNumbersToSixteenDigits) {
  // The expected values were computed with 200 bits. Each gain is a difference of numbers near 2, divided by
  // b0. The tolerance is a few roundings of these numbers.
  const auto c = place_poles(current, 1e-3, 0.9, period_s), s = place_poles(speed, 10e-3, 0.9, period_s);
  ASSERT_TRUE(c && s);
  EXPECT_NEAR(c->w0_rad_s, 5111.1111111111111, 8 * eps * 5111);
  EXPECT_NEAR(c->gains.d1, 4.0955879324779784746, 8 * eps / current.b0);
  EXPECT_NEAR(c->gains.d0, -3.693963076125325421, 8 * eps / current.b0);
  EXPECT_NEAR(speed.b0, 1.7333192741500979084, 4 * eps);
  EXPECT_NEAR(s->gains.d1, 0.01582989934309679539, 8 * eps / speed.b0);
  EXPECT_NEAR(s->gains.d0, -0.015696114596826115691, 8 * eps / speed.b0);
}

TEST(PolePlacement, TheClosedLoopsPolynomialHasTheWantedRoots) {
  for (const double settle_s : {0.3e-3, 0.92e-3, 1e-3, 5e-3, 0.5}) {
    for (const double damping : {0.1, 0.5, 0.7071, 0.9, 1.0}) {
      for (const ZohPlant& plant : {current, speed, speed_plant(0.78, 1.35e-5, 0.0, period_s)}) {
        const auto p = place_poles(plant, settle_s, damping, period_s);
        ASSERT_TRUE(p);
        // An independent check in long double: the pole z is inserted into (z - 1)(z + a0) + b0 (d1 z + d0).
        const Wide w0 = 4.6L / (Wide(damping) * settle_s);
        const std::complex<Wide> s{-damping * w0, w0 * std::sqrt(1.0L - Wide(damping) * damping)};
        const std::complex<Wide> z = std::exp(s * Wide(period_s));
        const std::complex<Wide> closed =
            (z - 1.0L) * (z + Wide(plant.a0)) + Wide(plant.b0) * (Wide(p->gains.d1) * z + Wide(p->gains.d0));
        EXPECT_LE(std::abs(closed), 16 * eps) << settle_s << ' ' << damping;
        EXPECT_NEAR(p->z_re, static_cast<double>(z.real()), 4 * eps);
        EXPECT_NEAR(p->z_im, static_cast<double>(z.imag()), 4 * eps);
      }
    }
  }
}

TEST(ZohPlants, AreTheStepResponsesAfterOnePeriod) {
  // The relation also holds if the pole is so slow that 1 - exp(-x) would lose its digits.
  for (double x = 1e-12; x < 40.0; x *= 1.7) {
    const ZohPlant p = current_plant(2.0, 2.0 * period_s / x, period_s);
    const Wide b0 = -std::expm1(-Wide(x)) / 2.0L;
    EXPECT_NEAR(p.b0 / static_cast<double>(b0), 1.0, 8 * eps) << x;
    EXPECT_NEAR(p.a0, static_cast<double>(-std::exp(-Wide(x))), 4 * eps) << x;
  }
  // If the friction is nearly 0, the plant is a pure integrator.
  EXPECT_EQ(speed_plant(0.78, 1.35e-5, 0.0, period_s).a0, -1.0);
  EXPECT_NEAR(speed_plant(0.78, 1.35e-5, 1e-20, period_s).b0, speed_plant(0.78, 1.35e-5, 0.0, period_s).b0,
              8 * eps);
}

TEST(PolePlacement, ShowsItsDerivation) {
  const auto p = place_poles(current, 1e-3, 0.9, period_s);
  ASSERT_TRUE(p);
  std::string symbols;
  for (const DerivationStep& step : p->steps) symbols += step.symbol + ' ';
  EXPECT_EQ(symbols, "T_reg xi T_s w0 Re s Im s Re z Im z a0 b0 c1 c0 d1 d0 K K_i ");
  EXPECT_EQ(p->steps.back().value, p->gains.d0 + p->gains.d1);
}

TEST(PolePlacement, NamesEveryInputItCannotUse) {
  const auto p = place_poles({-0.9, 0.0}, -1.0, 1.2, 0.0);
  ASSERT_FALSE(p);
  ASSERT_EQ(p.problems().size(), 4u);
  EXPECT_EQ(p.problems()[0].where, "period_s");
  EXPECT_EQ(p.problems()[1].where, "settle_s");
  EXPECT_EQ(to_string(p.problems()[2]),
            "damping = 1.2 must be above 0 and at most 1; give a damping up to 1; the thesis uses 0.9");
  EXPECT_FALSE(place_poles(current, std::nan(""), 0.9, period_s));
}

}  // namespace SIXSTEP_TEST_FILE
