// SPDX-License-Identifier: Apache-2.0
// The gains of the tracking loop are compared with the poles of its polynomial, and with the specified
// response.
#include "sixstep/design/loops/tracking_loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdint>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/random.hpp"

namespace sixstep::design {
namespace SIXSTEP_TEST_FILE {

using Number = std::complex<double>;

/// Roots of z^2 + (K_p + K_i - 2) z + 1 - K_p.
std::pair<Number, Number> poles(double K_p, double K_i) {
  const double half = (2 - K_p - K_i) / 2;
  const Number root = std::sqrt(Number(half * half - (1 - K_p)));
  return {half + root, half - root};
}

TEST(TrackingLoop, ItsPolesAreThoseOfFrequencyAndDamping) {
  for (const double damping : {0.3, 0.7, 1.0, 1.6})
    for (const double bandwidth : {10.0, 1000.0, 20000.0}) {
      const double T = 1e-4;
      const auto design = tracking_loop({bandwidth, damping, T});
      ASSERT_TRUE(design);
      const auto [z1, z2] = poles(design->K_p, design->K_i);
      const Number s1 = std::log(z1) / T, s2 = std::log(z2) / T;
      // The accuracy of a double pole is the square root of the rounding error of the gains, which is 1e-16
      // for gains near 1.
      const double near = 4e-8 / T;
      EXPECT_NEAR(std::sqrt(std::abs(s1 * s2)), design->natural_rad_s, near) << damping << ' ' << bandwidth;
      EXPECT_NEAR(-(s1 + s2).real() / 2, damping * design->natural_rad_s, near);
      EXPECT_TRUE(tracking_is_stable(design->K_p, design->K_i));
      EXPECT_DOUBLE_EQ(design->K_a_per_s2, design->K_i / (T * T));
    }
}

TEST(TrackingLoop, FollowsByOneOverRoot2AtItsBandwidth) {
  for (const double damping : {0.3, 0.7, 1.0, 1.6})
    for (const double bandwidth : {50.0, 3000.0}) {
      const auto design = tracking_loop({bandwidth, damping, 1e-5});
      ASSERT_TRUE(design);
      const double w = design->natural_rad_s;
      const Number s(0, bandwidth);
      EXPECT_NEAR(std::abs((2 * damping * w * s + w * w) / (s * s + 2 * damping * w * s + w * w)),
                  std::sqrt(0.5), 1e-12);
      // The sampled loop is (K_p (z - 1) + K_i z) divided by its polynomial. It has this response with an
      // error of about w_b T (bandwidth w_b, period T).
      const Number z = std::exp(s * 1e-5);
      const Number sampled = (design->K_p * (z - 1.0) + design->K_i * z) /
                             (z * z + (design->K_p + design->K_i - 2) * z + (1 - design->K_p));
      EXPECT_NEAR(std::abs(sampled), std::sqrt(0.5), bandwidth * 1e-5);
    }
}

TEST(TrackingLoop, JurysTestIsThatOfThePoles) {
  int stable = 0;
  for (std::uint64_t n = 0; n < 10000; ++n) {
    const double K_p = -0.5 + 3.5 * base::uniform({1, 0, n}), K_i = -0.5 + 5 * base::uniform({1, 1, n});
    const auto [z1, z2] = poles(K_p, K_i);
    const double largest = std::max(std::abs(z1), std::abs(z2));
    if (std::fabs(largest - 1) < 1e-9) continue;
    ASSERT_EQ(tracking_is_stable(K_p, K_i), largest < 1)
        << K_p << ' ' << K_i << ", draw " << n << " of seed 1";
    stable += largest < 1;
  }
  EXPECT_GT(stable, 1000);
}

TEST(TrackingLoop, GainsTakenOverFromTimeAreUnstableFromTheirLimitOn) {
  for (const double damping : {0.3, 0.7, 1.0, 1.6}) {
    const double limit = taken_over_limit(damping);
    for (const double part : {0.999, 1.001}) {
      const double x = part * limit;
      EXPECT_EQ(tracking_is_stable(2 * damping * x, x * x), part < 1) << damping;
    }
  }
}

TEST(TrackingLoop, TheChipsGainsAreTheDesignsTo31Bits) {
  const auto design = tracking_loop({600, 0.9, 5e-5});
  ASSERT_TRUE(design);
  const control::TrackingConfig config = tracking_config(*design);
  EXPECT_NEAR(static_cast<double>(config.K_p), design->K_p, design->K_p * 0x1p-31);
  EXPECT_NEAR(static_cast<double>(config.K_i), design->K_i, design->K_i * 0x1p-31);
  control::TrackingState state;
  state.speed = std::int64_t{1} << 46;  // a quarter of a turn per tick
  EXPECT_NEAR(control::tracking_speed(state) * design->speed_rad_s_unit, base::pi / 2 / 5e-5, 1e-9);
}

TEST(TrackingLoop, RefusesWhatIsNoLoop) {
  EXPECT_FALSE(tracking_loop({0, 1, 1e-4}));
  EXPECT_FALSE(tracking_loop({100, -1, 1e-4}));
  EXPECT_FALSE(tracking_loop({100, 1, 0}));
  EXPECT_FALSE(tracking_loop({std::nan(""), 1, 1e-4}));
  const auto too_fast = tracking_loop({base::pi / 1e-4, 1, 1e-4});
  ASSERT_FALSE(too_fast);
  EXPECT_EQ(too_fast.problems().front().where, "bandwidth_rad_s");
  EXPECT_TRUE(tracking_loop({0.999 * base::pi / 1e-4, 1, 1e-4}));
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace sixstep::design
