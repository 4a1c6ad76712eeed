// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/scaling/scaling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sixstep/control/drive.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::control;
using design::OperatingRange;

/// The cascade of the thesis (chapter 6) for the maxon 251601.
DriveConfig<double> cascade(Mode mode) {
  DriveConfig<double> d;
  d.mode = mode;
  d.current = {4.0956, -3.6940, 24.0};
  d.nominal_bus_V = 24.0;
  d.speed = {0.0158299, -0.0156961, 1.0};
  d.current_at_full_torque_A = 0.78 / 0.0335;
  d.current_limit_A = 10.0;
  d.position_gain = 0.5;
  d.speed_limit_rad_s = 300.0;
  return d;
}

OperatingRange range(Mode mode) {
  return {.current_A = 20.0,
          .speed_rad_s = 720.0,
          .position_deg = 1500.0,
          .bus_V = 30.0,
          .setpoint = mode == Mode::current ? 10.0
                      : mode == Mode::speed ? 700.0
                                            : 1200.0};
}

template <class Scalar>
class Scaling : public ::testing::Test {};
using Formats = ::testing::Types<Q15, Q31, Q14, Fixed<std::int32_t, 29>>;
TYPED_TEST_SUITE(Scaling, Formats);

template <class S>
constexpr double digit = static_cast<double>(S::from_raw(1));

/// The inputs are at the ends of their ranges or anywhere between, for several ticks. If a sum saturated
/// although the proof excludes it, the result would be wrong by a large part of full scale. Rounding causes
/// much smaller errors.
TYPED_TEST(Scaling, CornersOfTheRangeFollowDoubleWithinTheirResolution) {
  using S = TypeParam;
  constexpr int seed = 251601;
  std::mt19937_64 random{seed};
  std::uniform_real_distribution<double> any(-1, 1);
  for (const Mode mode : {Mode::current, Mode::speed, Mode::position}) {
    const DriveConfig<double> d = cascade(mode);
    const OperatingRange r = range(mode);
    const auto scaled = design::scaled<S>(d, r);
    ASSERT_TRUE(scaled) << base::to_string(scaled.problems()[0]);
    const design::Bases b = scaled->bases;
    // The tolerances are one digit of each signal, in SI units. The rounded values are a measured current,
    // the half difference and the reference. A gain has a relative error of 2^(1-bits), multiplied by at most
    // full scale.
    const double gains = std::ldexp(1.0, 1 - 8 * int{sizeof(S)});
    const double i = b.current_A * digit<S>, w = b.speed_rad_s * digit<S>, p = b.position_deg * digit<S>;
    const double u = b.voltage_V * digit<S>;
    const double w_ref_off =
        mode == Mode::position ? 1.5 * p * d.position_gain + gains * d.speed_limit_rad_s + w : w;
    const double w_off = w_ref_off + w;
    const double jump_w = 2 * (r.speed_rad_s + (mode == Mode::position ? 300 : 700));
    const double K_i_w = d.speed.d1 + d.speed.d0, K_i_c = d.current.d1 + d.current.d0;
    for (int run = 0; run < 2000; ++run) {
      DriveState<double> exact{};
      DriveState<S> fixed{};
      double fraction_off = 0, u_off = 0;
      for (int n = 0; n < 4; ++n) {
        const auto pick = [&](double most) {
          const std::uint64_t k = random() % 4;
          return k == 0 ? most : k == 1 ? -most : k == 2 ? 0.0 : most * any(random);
        };
        const double i_k = pick(r.current_A), speed = pick(r.speed_rad_s), at = pick(r.position_deg);
        const double setpoint = pick(r.setpoint);
        const Measurement<double> m{i_k, -i_k, 0, speed, at, 24.0, 0b100};
        const Measurement<S> q{S(i_k / b.current_A),   S(-i_k / b.current_A), S{},  S(speed / b.speed_rad_s),
                               S(at / b.position_deg), S(24.0 / b.voltage_V), 0b100};
        const double mode_base = mode == Mode::current ? b.current_A
                                 : mode == Mode::speed ? b.speed_rad_s
                                                       : b.position_deg;
        Telemetry<double> t;
        Telemetry<S> s;
        step(d, exact, m, {setpoint}, t);
        step(scaled->config, fixed, q, {S(setpoint / mode_base)}, s);
        double i_ref_off = i;
        if (mode != Mode::current) {
          // The limits of pi_step() never increase a difference between both calculations. Each tick
          // therefore adds only the error of its increments.
          fraction_off += d.speed.d1 * 2 * w_off + K_i_w * w_off + gains * (d.speed.d1 + K_i_w) * jump_w;
          i_ref_off = d.current_at_full_torque_A * (fraction_off + 2 * digit<S> + gains) + i;
          ASSERT_NEAR(static_cast<double>(s.current_reference_A) * b.current_A, t.current_reference_A,
                      i_ref_off)
              << "seed " << seed << " run " << run << " tick " << n << " mode " << static_cast<int>(mode);
        }
        const double i_off = i_ref_off + 2 * i;
        u_off += d.current.d1 * 2 * i_off + K_i_c * i_off + gains * (d.current.d1 + K_i_c) * 2 * 40.0 + u;
        ASSERT_NEAR(static_cast<double>(s.duty), t.duty, u_off / 24.0 + gains + 2 * digit<S>)
            << "seed " << seed << " run " << run << " tick " << n << " mode " << static_cast<int>(mode);
      }
    }
  }
}

TYPED_TEST(Scaling, EveryLineOfTheProofStaysWithinFullScale) {
  using S = TypeParam;
  for (const Mode mode : {Mode::duty, Mode::current, Mode::speed, Mode::position}) {
    const auto scaled = design::scaled<S>(cascade(mode), range(mode));
    ASSERT_TRUE(scaled);
    for (const design::Headroom& row : scaled->proof)
      EXPECT_LE(row.largest, row.full_scale * (1 + 2 * digit<S>)) << row.name;
  }
}

bool names(const base::Problems& problems, const std::string& where) {
  for (const base::Problem& p : problems)
    if (p.where == where && !p.limit.empty() && !p.cure.empty()) return true;
  return false;
}

TYPED_TEST(Scaling, WhatDoesNotFitIsNamed) {
  using S = TypeParam;
  const DriveConfig<double> d = cascade(Mode::position);
  const OperatingRange r = range(Mode::position);
  const design::Bases good = design::bases_for(d, r, static_cast<double>(S::max()));
  struct Case {
    double design::Bases::*base;
    const char* where;
  };
  for (const Case& c :
       {Case{&design::Bases::current_A, "current error"}, Case{&design::Bases::speed_rad_s, "speed error"},
        Case{&design::Bases::position_deg, "position error"}, Case{&design::Bases::voltage_V, "bus"}}) {
    design::Bases small = good;
    small.*c.base *= 0.99;
    const auto scaled = design::scaled<S>(d, r, small);
    ASSERT_FALSE(scaled) << c.where;
    EXPECT_TRUE(names(scaled.problems(), c.where)) << c.where;
  }
}

TYPED_TEST(Scaling, GainsThatTheFormatCannotHoldAreNamed) {
  using S = TypeParam;
  DriveConfig<double> slow = cascade(Mode::speed);
  const bool narrow = sizeof(S) == 2;
  slow.speed = {1e-3, -1e-3 + (narrow ? 1e-8 : 1e-13), 1.0};
  const auto blind = design::scaled<S>(slow, range(Mode::speed));
  ASSERT_FALSE(blind);
  EXPECT_TRUE(names(blind.problems(), "speed.K_i"));
  DriveConfig<double> steep = cascade(Mode::current);
  steep.current = {1e12, -1e12, 24.0};
  const auto beyond = design::scaled<S>(steep, range(Mode::current));
  ASSERT_FALSE(beyond);
  EXPECT_TRUE(names(beyond.problems(), "current.d1"));
  DriveConfig<double> eager = cascade(Mode::current);
  eager.current = {100.0, 0.0, 24.0};
  const auto saturating = design::scaled<S>(eager, range(Mode::current));
  ASSERT_FALSE(saturating);
  EXPECT_TRUE(names(saturating.problems(), "current integral increment"));
}

/// The slewed setpoint starts at the measured speed, which may be full speed backwards. The largest error is
/// therefore twice the full speed, even if the setpoint is small.
TYPED_TEST(Scaling, ASlewedSetpointBeginsAtWhatIsMeasured) {
  DriveConfig<double> d = cascade(Mode::speed);
  OperatingRange r = range(Mode::speed);
  r.setpoint = 100.0;
  const auto error_of = [&] {
    const auto scaled = design::scaled<TypeParam>(d, r);
    EXPECT_TRUE(scaled);
    for (const design::Headroom& row : scaled->proof)
      if (row.name == "speed error") return row.largest;
    return 0.0;
  };
  EXPECT_EQ(error_of(), 820.0);
  d.extras.on = d.extras.slews_setpoint = true;
  d.extras.slew.step = 0.5;
  EXPECT_EQ(error_of(), 1440.0);
}

/// The derivative and its integral are sums of 16 times the output. The fastest change of the measured speed
/// determines their largest values.
TYPED_TEST(Scaling, AnIntegralBehindASteepDerivativeIsProved) {
  DriveConfig<double> d = cascade(Mode::speed);
  OperatingRange r = range(Mode::speed);
  d.extras.on = true;
  d.extras.speed_law = control::SpeedLaw::positional;
  d.extras.speed = {0.0158, 0.00013, 0.00013 / 0.0158, 0.97};
  d.extras.speed_derivative = {0.05, 0.01};  // 72 times the output for a speed jump over the whole range
  const auto jumping = design::scaled<TypeParam>(d, r);
  ASSERT_FALSE(jumping);
  EXPECT_TRUE(names(jumping.problems(), "speed derivative and integral"));
  r.speed_change_rad_s = 0.5;  // 2.5 times the output
  EXPECT_TRUE(design::scaled<TypeParam>(d, r));
  d.extras.speed.K_b = 0.0;
  const auto free = design::scaled<TypeParam>(d, r);
  ASSERT_FALSE(free);
  EXPECT_TRUE(names(free.problems(), "speed.K_b"));
}

}  // namespace SIXSTEP_TEST_FILE
