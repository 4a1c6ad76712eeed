// SPDX-License-Identifier: Apache-2.0
// The jerk-limited profile is tested for its limits at every tick, its end point and its duration.
#include "sixstep/control/jerk_profile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "sixstep/base/angle.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;
using sixstep::base::pi;

static_assert(std::is_trivially_copyable_v<JerkProfileState<float>>);
static_assert(sizeof(JerkProfileState<float>) <= 384, "what a drive without a profile pays in memory");

constexpr double degrees = 180 / pi;

/// Resolution of the scalar S relative to 1.
template <class S>
constexpr double ulp = static_cast<double>(std::numeric_limits<S>::epsilon());

template <class S>
struct Mover {
  JerkProfileLimits limits;
  double T;
  JerkProfileConfig<S> config = jerk_profile<S>(limits, T);
  JerkProfileState<S> state{};

  Mover(const JerkProfileLimits& of, double period_s, double at_deg = 0.0, double speed_rad_s = 0.0)
      : limits(of), T(period_s) {
    begin_profile(config, state, static_cast<S>(at_deg), static_cast<S>(speed_rad_s));
  }
  const ProfiledMotion<S>& step(double target) {
    return jerk_profile_step(config, state, static_cast<S>(target));
  }
  bool rests(double target) const {
    return state.now.position_deg == static_cast<S>(target) && state.now.speed_rad_s == S{} &&
           state.now.acceleration_rad_s2 == S{} && state.velocity == 0 && state.way == 0;
  }
  double stride_s() const { return config.ticks * T; }
  double rises_s() const { return config.cells * stride_s(); }
  double jerk() const { return limits.acceleration_rad_s2 / rises_s(); }
  double count_deg() const { return static_cast<double>(config.deg_per_part) * config.cells; }
  /// Number of ticks until the profile rests at the target.
  int land(double target, int most = 4000000) {
    int n = 0;
    while (n < most && !rests(target)) {
      step(target);
      ++n;
    }
    return n;
  }
};

/// Largest fractions of the limits that any tick uses.
template <class S>
struct Shares {
  double speed = 0.0, acceleration = 0.0, jerk = 0.0, travel = 0.0, farthest = 0.0;

  void take(const Mover<S>& m, const ProfiledMotion<S>& before, const ProfiledMotion<S>& now) {
    const auto d = [](S x) { return static_cast<double>(x); };
    const JerkProfileLimits& l = m.limits;
    const double way = std::fabs(d(now.position_deg) - d(before.position_deg));
    farthest = std::fmax(farthest, std::fabs(d(m.state.target_deg)));
    // A new target is between two counts, and a position has the resolution of the scalar.
    const double half = m.count_deg() / 2 + 2 * ulp<S> * (std::fabs(d(now.position_deg)) + 2 * farthest);
    speed = std::fmax(speed, std::fabs(d(now.speed_rad_s)) / l.speed_rad_s);
    acceleration = std::fmax(acceleration, std::fabs(d(now.acceleration_rad_s2)) / l.acceleration_rad_s2);
    jerk = std::fmax(jerk, std::fabs(d(now.acceleration_rad_s2) - d(before.acceleration_rad_s2)) /
                               (m.jerk() * m.T + 2 * ulp<S> * l.acceleration_rad_s2));
    travel = std::fmax(travel, (way - half) / (l.speed_rad_s * degrees * m.T));
  }
  double largest() const { return std::fmax(std::fmax(speed, acceleration), std::fmax(jerk, travel)); }
};

template <class Scalar>
class JerkProfile : public ::testing::Test {};
using Floating = ::testing::Types<double, float>;
TYPED_TEST_SUITE(JerkProfile, Floating);

/// The tolerance is 4 units in the last place (ulp), for the products in the calculation.
template <class S>
constexpr double exact = 1 + 4 * ulp<S>;

TYPED_TEST(JerkProfile, ALongMoveTakesTheClosedForm) {
  for (const double smoothing : {0.0, 1e-3, 5e-3, 3.2e-3, 50e-3}) {
    Mover<TypeParam> m({100.0, 5000.0, smoothing}, 50e-6, 10.0);
    Shares<TypeParam> shares;
    const double d = 3600.0;
    int n = 0;
    for (ProfiledMotion<TypeParam> before = m.state.now; !m.rests(10.0 + d) && n < 100000; ++n) {
      shares.take(m, before, m.step(10.0 + d));
      before = m.state.now;
    }
    const double formula = d / degrees / 100.0 + 100.0 / 5000.0 + m.rises_s();
    EXPECT_NEAR(n * m.T, formula, 4 * m.stride_s()) << smoothing;
    EXPECT_LE(shares.largest(), exact<TypeParam>) << smoothing;
    EXPECT_NEAR(shares.speed, 1.0, 1e-6);
    EXPECT_NEAR(shares.acceleration, std::fmin(1.0, 100.0 / 5000.0 / m.rises_s()), 1e-3);
    EXPECT_NEAR(shares.jerk, 1.0, 1e-3) << "as fast as the limit allows";
  }
}

/// The fastest move over d that reaches the acceleration limit a but not the speed limit takes a/j +
/// sqrt((a/j)^2 + 4 d/a), with the jerk limit j.
TYPED_TEST(JerkProfile, AShortMoveIsTheFastestOfItsJerk) {
  for (const double d_rad : {0.3, 0.8, 1.5}) {
    Mover<TypeParam> m({100.0, 5000.0, 3.2e-3}, 50e-6);
    const double rises = m.rises_s();
    const double best = rises + std::sqrt(rises * rises + 4 * d_rad / 5000.0);
    EXPECT_NEAR(m.land(d_rad * degrees) * m.T, best, 4 * m.stride_s()) << d_rad;
  }
}

/// If the limits are whole counts, the speed over time is symmetric.
TYPED_TEST(JerkProfile, AMoveIsSymmetric) {
  const double T = 1.0 / 4096, stride_deg = 64.0 * T * degrees;  // full speed 64 rad/s
  for (const int strides : {40, 200, 1000}) {
    Mover<TypeParam> m({64.0, 64.0 * 4096 / 64, 32 * T}, T);
    ASSERT_EQ(m.config.ticks, 1);
    ASSERT_EQ(m.config.cells, 32);
    m.config.acceleration = jerk_profile_speed / 64;
    const double target = strides * stride_deg;
    std::vector<double> speed;
    while (!m.rests(target) && speed.size() < 10000)
      speed.push_back(static_cast<double>(m.step(target).speed_rad_s));
    while (!speed.empty() && speed.back() == 0) speed.pop_back();
    const double one_count = 64.0 / jerk_profile_speed;
    // If the speed is no multiple of the acceleration, the remainder is subtracted in the first step of
    // braking instead of the last step.
    const double near = strides >= 200 ? 64 * one_count : 1.01 * 64.0 / 64;
    for (std::size_t n = 0; n < speed.size(); ++n)
      ASSERT_NEAR(speed[n], speed[speed.size() - 1 - n], near) << strides << " strides, tick " << n;
  }
}

double decades(std::mt19937_64& random, double from, double to) {
  return from * std::pow(to / from, std::uniform_real_distribution<double>(0, 1)(random));
}

TYPED_TEST(JerkProfile, KeepsItsLimitsWhateverIsAskedAndLandsExactly) {
  constexpr int seed = 2026;
  std::mt19937_64 random{seed};
  std::uniform_real_distribution<double> sided(-1, 1);
  for (int run = 0; run < 400; ++run) {
    const double T = 50e-6, v = decades(random, 1, 1000), a = v / decades(random, 1e-3, 0.5);
    const double moving = run % 3 == 0 ? sided(random) * v : 0.0;
    Mover<TypeParam> m({v, a, decades(random, 1e-5, 0.05)}, T, 100 * sided(random), moving);
    const double reach = v * v / a * degrees, every = decades(random, 1, 3000);
    Shares<TypeParam> shares;
    double target = 0.0;
    ProfiledMotion<TypeParam> before = m.state.now;
    for (int n = 0; n < 8000; ++n) {
      if (n == 0 || random() % static_cast<unsigned>(every) == 0)
        target = static_cast<double>(before.position_deg) + sided(random) * reach * decades(random, 1e-4, 3);
      shares.take(m, before, m.step(target));
      before = m.state.now;
    }
    ASSERT_LE(shares.largest(), exact<TypeParam>)
        << "seed " << seed << " run " << run << ": " << shares.speed << ' ' << shares.acceleration << ' '
        << shares.jerk << ' ' << shares.travel;
    ASSERT_LT(m.land(target), 4000000) << "seed " << seed << " run " << run;
    for (int n = 0; n < 200; ++n) m.step(target);
    ASSERT_TRUE(m.rests(target)) << "seed " << seed << " run " << run << ": it stays there";
  }
}

/// A million ticks set a new target each. Afterwards, no sum has a remainder.
TYPED_TEST(JerkProfile, NothingDrifts) {
  Mover<TypeParam> m({200.0, 4000.0, 4e-3}, 50e-6);
  for (int n = 0; n < 1000000; ++n) m.step(300 * std::sin(n * 1e-3) + 1e-3 * n);
  ASSERT_LT(m.land(123.456), 4000000);
  EXPECT_EQ(m.state.rest, 0);
  EXPECT_EQ(m.state.now.position_deg, static_cast<TypeParam>(123.456));
}

TYPED_TEST(JerkProfile, ATargetSetTooNearIsPassedAndReturnedTo) {
  Mover<TypeParam> m({100.0, 5000.0, 5e-3}, 50e-6);
  for (int n = 0; n < 2000; ++n) m.step(10000.0);
  ASSERT_NEAR(static_cast<double>(m.state.now.speed_rad_s), 100.0, 1e-4);
  const double here = static_cast<double>(m.state.now.position_deg), target = here + 10.0;
  // The braking distance is v^2/2a + v/2 a/j (speed v, acceleration a, jerk j). The part already in progress
  // is at most three steps and is subtracted.
  const double stops = (100.0 * 100.0 / 10000.0 + 50.0 * m.rises_s()) * degrees;
  double farthest = here;
  Shares<TypeParam> shares{.farthest = 10000.0};
  ProfiledMotion<TypeParam> before = m.state.now;
  for (int n = 0; n < 5000 && !m.rests(target); ++n) {
    shares.take(m, before, m.step(target));
    before = m.state.now;
    farthest = std::fmax(farthest, static_cast<double>(before.position_deg));
  }
  EXPECT_TRUE(m.rests(target));
  EXPECT_NEAR(farthest - here, stops, 4 * 100.0 * m.stride_s() * degrees);
  EXPECT_LE(shares.largest(), exact<TypeParam>);
}

TYPED_TEST(JerkProfile, BeginsInFlightWithoutAJump) {
  Mover<TypeParam> m({100.0, 5000.0, 5e-3}, 50e-6, 720.0, -40.0);
  const double first = static_cast<double>(m.step(720.0).position_deg);
  const double bends = m.jerk() * 50e-6 * 50e-6 * 50e-6 / 6 * degrees;  // it brakes from the first tick on
  EXPECT_NEAR(first - 720.0, -40.0 * 50e-6 * degrees + bends, m.count_deg() + 720.0 * ulp<TypeParam>);
  EXPECT_NEAR(static_cast<double>(m.state.now.speed_rad_s), -40.0, 40.0 * 1e-2);
  EXPECT_LT(m.land(720.0), 5000);
}

TYPED_TEST(JerkProfile, SmoothsForWholeStridesAndNotLess) {
  for (int periods = 0; periods < 3000; ++periods) {
    const JerkProfileConfig<double> c = jerk_profile({10.0, 100.0, periods * 30e-6}, 30e-6);
    ASSERT_GE(c.ticks * c.cells, periods);
    ASSERT_LE(c.ticks * c.cells, std::fmax(periods, 1) * 65.0 / 64 + 1);
    ASSERT_LE(c.cells, jerk_profile_cells);
  }
}

TYPED_TEST(JerkProfile, SmallAndFarAndNothing) {
  using S = TypeParam;
  Mover<S> small({100.0, 5000.0, 50e-3}, 50e-6);
  for (const double counts : {1.0, 2.0, 63.0, 64.0, 65.0, 1000.0}) {
    const double target = counts * small.count_deg();
    EXPECT_LT(small.land(target), 5000) << counts;
  }
  // The target is beyond the range of the counts. The profile moves there at full speed, without a jump.
  Mover<S> far({1e-3, 1.0, 1e-3}, 50e-6);
  for (int n = 0; n < 1000; ++n) far.step(1e9);
  EXPECT_NEAR(static_cast<double>(far.state.now.speed_rad_s), 1e-3, 1e-9);
  EXPECT_LT(static_cast<double>(far.state.now.position_deg), 1000 * 50e-6 * 1e-3 * degrees);
  JerkProfileState<S> still{};
  begin_profile(JerkProfileConfig<S>{}, still, S(3), S(0));
  EXPECT_EQ(jerk_profile_step(JerkProfileConfig<S>{}, still, S(7)).position_deg, S(3))
      << "the default never moves";
  EXPECT_EQ(jerk_profile({0.0, 1.0, 1.0}, 1e-4), JerkProfileConfig<double>{});
}

}  // namespace SIXSTEP_TEST_FILE
