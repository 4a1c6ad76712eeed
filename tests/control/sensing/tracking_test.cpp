// SPDX-License-Identifier: Apache-2.0
#include "sixstep/control/sensing/tracking.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <type_traits>

#include "tests/control/scalars.hpp"
#include "tests/control/sensing/drawn.hpp"
#include "tests/control/sensing/second_order.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

static_assert(std::is_trivially_copyable_v<TrackingState>);

constexpr double turn = 4294967296.0;

/// After a step of the angle, the loop's error decays like the error of the linear loop, which is computed
/// from the poles.
TEST(Tracking, AStepDecaysAsThePolesSay) {
  for (const double damping : {0.4, 0.7, 0.95})
    for (const double x : {0.003, 0.03, 0.3}) {
      const SecondOrder law(x, damping);
      const double rounding = law.rounding();
      const TrackingConfig config = law.config();
      const BinaryAngle to = 0xfff00000u;  // backwards, across zero
      const double step = way_between(0, to);
      TrackingState state;
      for (int n = 0; n * x < 10; ++n) {
        ASSERT_NEAR(way_between(state.angle, to), step * law.error(n), rounding + std::fabs(step) * 1e-9)
            << damping << ' ' << x << " at " << n;
        tracking_follow(config, state, to);
      }
    }
}

/// Over many turns, the error is 0 at constant speed. At the constant acceleration a, it is a/K_a, with the
/// acceleration constant K_a of the loop.
TEST(Tracking, ConstantAccelerationLeavesItsErrorAndNoMore) {
  for (const double damping : {0.5, 1.0})
    for (const double x : {0.01, 0.1})
      for (const std::int32_t a : {0, 100, -20000}) {
        const SecondOrder law(x, damping);
        const double rounding = law.rounding();
        TrackingState state;
        std::int64_t place = 12345, speed = a == 0 ? 30000000 : 0;
        const double e = a / law.K_i();
        for (int n = 0; n < static_cast<int>(40 / (damping * x)); ++n) {
          tracking_follow(law.config(), state, static_cast<BinaryAngle>(static_cast<std::uint64_t>(place)));
          speed += a;
          place += speed;
        }
        EXPECT_NEAR(state.error, e, rounding + std::fabs(e) * 1e-6) << damping << ' ' << x << ' ' << a;
        // The next step of the angle is w[n+1] + K_p e, so the estimated speed w is below the true speed by
        // K_p e (error e, proportional gain K_p).
        EXPECT_NEAR(tracking_speed(state), static_cast<double>(speed) - law.K_p() * e,
                    2 * rounding + std::fabs(e) * 1e-6);
        EXPECT_GT(std::abs(place), std::int64_t{1} << (a == 0 ? 33 : 22)) << "it moved";
      }
}

TEST(Tracking, ForwardAndBackwardAreMirrored) {
  const SecondOrder law(0.05, 0.7);
  TrackingState a, b;
  Drawn drawn{3};
  for (int n = 0; n < 10000; ++n) {
    const auto error = static_cast<std::int32_t>(drawn.word()) >> 1;
    tracking_step(law.config(), a, error);
    tracking_step(law.config(), b, -error);
    ASSERT_EQ(a.angle + b.angle, 0u);
    ASSERT_EQ(a.speed, -b.speed);
  }
}

/// The estimated speed stays within half a turn per tick, however long the error lasts.
TEST(Tracking, TheSpeedIsBounded) {
  const SecondOrder law(0.5, 0.7);
  TrackingState state;
  for (int n = 0; n < 1000; ++n) tracking_step(law.config(), state, 0x7fffffff);
  EXPECT_EQ(tracking_speed(state), 0x7fffffff);
  EXPECT_EQ(state.speed, std::int64_t{1} << 47);
}

TEST(Tracking, TheDefaultStands) {
  TrackingState state;
  for (int n = 0; n < 10; ++n) tracking_follow(TrackingConfig{}, state, 1000000);
  EXPECT_EQ(state.angle, 0u);
  EXPECT_EQ(state.speed, 0);
}

template <class Scalar>
class TrackedSpeed : public ::testing::Test {};
TYPED_TEST_SUITE(TrackedSpeed, SensingScalars);

TYPED_TEST(TrackedSpeed, IsThatOfTheState) {
  using S = TypeParam;
  const double period = 5e-5, base = is_fixed<S> ? 4000.0 : 1.0;
  const double unit = 2 * std::numbers::pi / turn / period;
  const double own = is_fixed<S> ? std::ldexp(1.0, sizeof(S) == 2 ? -14 : -30) : 2 * digit<S>();
  for (double w = 1e-3; w < 4000; w *= -3.1) {
    TrackingState state;
    state.speed = static_cast<std::int64_t>(w / unit * 65536);
    EXPECT_NEAR(static_cast<double>(tracked_speed<S>(state, per_count<S>(unit / base))) * base, w,
                unit / 2 + std::fabs(w) * own + (is_fixed<S> ? digit<S>() * base / 2 : 0.0))
        << w;
  }
}

}  // namespace SIXSTEP_TEST_FILE
