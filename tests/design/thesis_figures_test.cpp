// SPDX-License-Identifier: Apache-2.0
// The numbers of the thesis's chapter 6 with their rounding, and the same rule computed exactly.
#include "sixstep/design/thesis/thesis_figures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <string_view>

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::design;

constexpr double period_s = 30e-6;
const PolePlacement current = *place_poles(current_plant(1.03, 0.572e-3, period_s), 1e-3, 0.9, period_s);
const PolePlacement speed = *place_poles(speed_plant(0.78, 1.35e-5, 7.3e-6, period_s), 10e-3, 0.9, period_s);

double printed(const char* loop, const char* symbol) {
  return thesis_figure(loop, loop == std::string_view("speed") ? speed : current, symbol).value_or(NAN);
}

TEST(ThesisFigures, ThePrintedGainsFollowFromThePrintedPoles) {
  struct Row {
    const char* loop;
    double half_d1, half_d0;  // half of the last printed digit
  };
  for (const auto& [loop, half_d1, half_d0] : {Row{"current", 0.05, 0.005}, Row{"speed", 0.5e-6, 0.5e-5}}) {
    const ZohPlant plant{printed(loop, "a0"), printed(loop, "b0")};
    const double re = printed(loop, "Re z"), im = printed(loop, "Im z");
    const PiGains gains = gains_for_poles(plant, re, im);
    // The printed pole z has an error of 0.5e-4. The printed a0 and b0 have errors of half of their last
    // digit. The tolerance is the effect of these errors on d1 and d0, plus half of the last digit of d1 and
    // d0.
    const bool is_speed = loop == std::string_view("speed");
    const double z = 0.5e-4, a0 = is_speed ? 0.5e-5 : 0.5e-4, b0 = (is_speed ? 0.5e-3 : 0.5e-4) / plant.b0;
    EXPECT_NEAR(gains.d1, printed(loop, "d1"), (2 * z + a0) / plant.b0 + std::fabs(gains.d1) * b0 + half_d1);
    EXPECT_NEAR(gains.d0, printed(loop, "d0"),
                (2 * (re + im) * z + a0) / plant.b0 + std::fabs(gains.d0) * b0 + half_d0);
    EXPECT_NEAR(printed(loop, "K_i"), printed(loop, "d1") + printed(loop, "d0"), 1e-12);
  }
}

TEST(ThesisFigures, ItsGainsBelongToAFasterPole) {
  // The gains 4.5 and -4.04 place poles with w0 = 5504 rad/s, xi = 0.908 and T_reg = 0.92 ms (model.md 13).
  // The test computes s = log(z)/T from the roots z of the closed-loop polynomial z^2 + c1 z + c0.
  const double a0 = printed("current", "a0"), b0 = printed("current", "b0");
  const double c1 = b0 * 4.5 + a0 - 1.0, c0 = b0 * -4.04 - a0;
  const std::complex<double> z{-c1 / 2, std::sqrt(c0 - c1 * c1 / 4)}, s = std::log(z) / period_s;
  const double w0 = std::abs(s), damping = -s.real() / w0;
  EXPECT_NEAR(w0, 5504, 0.5);
  EXPECT_NEAR(damping, 0.908, 0.5e-3);
  EXPECT_NEAR(4.6 / (damping * w0), 0.92e-3, 0.5e-5);
}

TEST(ThesisFigures, StandOnlyBesideTheThesissOwnDesign) {
  EXPECT_EQ(thesis_figure("current", current, "d1"), 4.5);
  EXPECT_EQ(thesis_figure("speed", speed, "K_i"), 0.000155);
  EXPECT_FALSE(thesis_figure("current", current, "w0"));  // the thesis does not print it
  const auto slower = place_poles(current.plant, 2e-3, 0.9, period_s);
  EXPECT_FALSE(thesis_figure("current", *slower, "d1"));
  const auto other = place_poles(current_plant(0.5, 0.2e-3, period_s), 1e-3, 0.9, period_s);
  EXPECT_FALSE(thesis_figure("current", *other, "d1"));
}

}  // namespace SIXSTEP_TEST_FILE
