// SPDX-License-Identifier: Apache-2.0
// The position loop with a profile on the simulated motor. The tests check its lag with and without
// feed-forward, the end of the move, the jerk of the shaft, the defaults from the sheet, and the refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sixstep/base/angle.hpp"
#include "sixstep/sim/run.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/compile/chip.hpp"
#include "sixstep/study/compile/compile.hpp"
#include "tests/support/figures.hpp"
#include "tests/support/product_scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using namespace sixstep::study;
using control::Mode;
using ::testing::HasSubstr;

constexpr double J = 1.35e-5, B = 7.3e-6, K_t = 0.0335, degrees = 180 / base::pi;
constexpr double v = 100.0, a = 3000.0, smoothing = 5e-3, gain = 0.5, way_deg = 3600.0;
/// The move lasts d/v + v/a + a/j (distance d, speed v, acceleration a, jerk j; a/j is the smoothing). The
/// speed is constant from v/a + a/j after its start until v/a + a/j before its end.
constexpr double cruises_from_s = 0.0384, cruises_to_s = 0.628, lands_s = 0.6667;

Scenario move(bool feed_forward, FirmwareKind drive = FirmwareKind::lean) {
  Scenario s = maxon_scenario(Mode::position, way_deg);
  s.duration_s = 1.0;
  s.control.drive = drive;
  s.control.position.gain_rad_s_per_deg = gain;
  s.control.position.profile = PositionProfile{.on = true,
                                               .speed_rad_s = v,
                                               .acceleration_rad_s2 = a,
                                               .jerk_rad_s3 = std::nullopt,
                                               .smoothing_s = smoothing,
                                               .feed_forward = feed_forward};
  if (drive == FirmwareKind::field) {
    s.sheet.back_emf = design::BackEmfShape::sine;
    s.sheet.torque_constant_mNm_A = std::nullopt;
    s.sheet.back_emf_mV_s = base::Quantity{16.75, "phase", ""};
    s.pwm.alignment = Alignment::centre;
    s.pwm.period_s = 50e-6;
    s.pwm.delay_periods = 1;
  }
  return s;
}

struct Moved {
  double lag_deg, speed_error_rad_s, current_A, highest_deg, landed_deg, at_the_end_deg;
};
Moved moved(Scenario s) {
  ask(s,
      over(MetricKind::mean, Signal::position_error, cruises_from_s + 0.36, cruises_to_s));  // after 10/K_p
  Measure error = over(MetricKind::mean, Signal::speed_error, 8e-3, 0.03);
  error.sampled = true;  // the reference is constant over a period, while the speed changes
  ask(s, error);
  ask(s, over(MetricKind::mean, Signal::current, 8e-3, 0.03));
  ask(s, over(MetricKind::maximum, Signal::position, 0.0));
  ask(s, over(MetricKind::maximum, Signal::position, 0.0, lands_s + 2e-3));
  ask(s, over(MetricKind::mean, Signal::position, 0.98));
  const std::vector<double> f = figures_of(s);
  return {f[0], f[1], f[2], f[3], f[4], f[5]};
}

/// A proportional position loop needs an error of v/K_p to move at the speed v (gain K_p). With feed-forward,
/// only losses that the sheet does not state cause an error.
TEST(PositionProfile, ALagOfVOverTheGainWithoutFeedForwardAndNoneWithIt) {
  for (const FirmwareKind drive : {FirmwareKind::lean, FirmwareKind::field}) {
    const Moved without = moved(move(false, drive)), with = moved(move(true, drive));
    std::printf(
        "drive %d: lag %.4g deg without, %.3g with; lands %.4g and %.4g deg short, passes by %.3g and %.3g deg\n",
        static_cast<int>(drive), without.lag_deg, with.lag_deg, way_deg - without.landed_deg,
        way_deg - with.landed_deg, without.highest_deg - way_deg, with.highest_deg - way_deg);
    EXPECT_NEAR(without.lag_deg, v / gain, 0.002 * v / gain);
    EXPECT_LT(std::fabs(with.lag_deg), 0.002 * v / gain);
    EXPECT_LT(way_deg - with.landed_deg, 0.5) << "2 ms after the profile has landed";
    EXPECT_GT(way_deg - without.landed_deg, 50.0);
    EXPECT_LT(with.highest_deg - way_deg, 0.5);
    EXPECT_NEAR(with.at_the_end_deg, way_deg, 0.05);
  }
}

/// The feed-forward supplies the torque J a + B w before the speed loop has an error (inertia J, acceleration
/// a, friction B, speed w).
TEST(PositionProfile, TheSpeedLoopIsLeftWithNothing) {
  const Moved without = moved(move(false)), with = moved(move(true));
  const double mean_w = 0.5 * a * (8e-3 + 0.03 - smoothing);
  std::printf(
      "speed error while it accelerates %.3g rad/s, told ahead %.3g; current %.4g A, J a + B w over K_t %.4g A\n",
      without.speed_error_rad_s, with.speed_error_rad_s, with.current_A, (J * a + B * mean_w) / K_t);
  EXPECT_NEAR(with.current_A, (J * a + B * mean_w) / K_t, 0.02 * J * a / K_t);
  EXPECT_LT(std::fabs(with.speed_error_rad_s), 0.2 * std::fabs(without.speed_error_rad_s));
}

struct SpeedWatch {
  std::vector<double>& speed;
  template <class Rig>
  void segment(const Rig& rig, double) {
    if (rig.ticked()) speed.push_back(static_cast<double>(rig.plant().state().w));
  }
  template <class Rig>
  bool done(const Rig&) {
    return false;
  }
};

/// The largest change of the shaft's acceleration from one window to the next, divided by the length of a
/// window. The acceleration is the difference of two speeds that are 2 ms apart.
double jerk_of_shaft(const Scenario& s) {
  const auto compiled = compile(s);
  EXPECT_TRUE(compiled);
  std::vector<double> speed;
  SpeedWatch watch{speed};
  const auto chip = chip_of<rig::FieldDrive<double>>(s, *compiled);
  auto rig = rig_of<rig::FieldDrive<double>>(*compiled, *chip, compiled->timeline);
  EXPECT_EQ(sim::run(rig, compiled->end, watch).stop, sim::Stop::end);
  constexpr std::size_t wide = 40;
  const double window_s = wide * s.pwm.period_s;
  double largest = 0.0;
  for (std::size_t n = 2 * wide; n < speed.size(); ++n)
    largest = std::max(largest, std::fabs(speed[n] - 2 * speed[n - wide] + speed[n - 2 * wide]));
  return largest / (window_s * window_s);
}

TEST(PositionProfile, TheShaftKeepsTheJerk) {
  Scenario s = move(true, FirmwareKind::field);
  const double profiled = jerk_of_shaft(s);
  s.control.position.profile = {};
  s.control.position.speed_limit_rad_s = v;
  const double stepped = jerk_of_shaft(s);
  std::printf("jerk of the shaft %.3g rad/s^3 of %.3g, with a step %.3g\n", profiled, a / smoothing, stepped);
  EXPECT_LT(profiled, 1.1 * a / smoothing);
  EXPECT_GT(profiled, 0.9 * a / smoothing);
  EXPECT_GT(stepped, 10 * profiled);
}

/// The profile runs in single precision, in the product drive with registers, and with a duty instead of a
/// current as output of the speed loop.
TEST(PositionProfile, EveryDriveWithAPositionLandsThere) {
  Scenario single = move(true);
  single.control.arithmetic = Arithmetic::float32;
  Scenario duty = move(true);
  duty.control.speed.output = SpeedOutput::duty;
  duty.control.speed.torque_limit_Nm.reset();
  Scenario positional = move(true);
  positional.control.speed.form = SpeedForm::positional;
  for (const Scenario& s : {single, duty, positional}) {
    const Moved m = moved(s);
    std::printf("lag %.3g deg, 2 ms after the landing %.3g deg short, passes by %.3g deg\n", m.lag_deg,
                way_deg - m.landed_deg, m.highest_deg - way_deg);
    EXPECT_LT(std::fabs(m.lag_deg), 0.005 * v / gain);
    EXPECT_LT(way_deg - m.landed_deg, 1.0);
    EXPECT_LT(m.highest_deg - way_deg, 1.0);
    EXPECT_NEAR(m.at_the_end_deg, way_deg, 0.1);
  }
}

/// Defaults of the profile. The acceleration uses four fifths of the torque limit. The speed is nine tenths
/// of the speed that the bus allows at this torque. The smoothing is the settling time of the speed loop.
TEST(PositionProfile, WhatIsNotGivenFollowsFromTheDrive) {
  Scenario s = move(true);
  s.control.position.profile = {};
  s.control.position.profile.on = true;
  s.control.speed.torque_limit_Nm = 0.1;
  s.control.speed.settle_s = 6e-3;
  const auto compiled = compile(s);
  ASSERT_TRUE(compiled);
  const control::ProfiledPositionConfig<double>& p = compiled->drive.extras.position;
  const double counts_s = p.profile.cells * static_cast<double>(control::jerk_profile_speed);
  EXPECT_NEAR(p.profile.rad_s_per_part * counts_s, 0.9 * (24.0 - 1.03 * 0.08 / K_t) / K_t, 1e-6);
  EXPECT_NEAR(p.profile.rad_s2_per_part * p.profile.cells * p.profile.acceleration, 0.8 * 0.1 / J, 1.0);
  EXPECT_NEAR(p.profile.ticks * p.profile.cells * s.pwm.period_s, 6e-3, s.pwm.period_s * p.profile.ticks * 2);
  EXPECT_NEAR(p.feed_forward.per_rad_s2, J / 0.1, 1e-12);
  EXPECT_NEAR(p.feed_forward.per_rad_s, B / 0.1, 1e-12);
  s.control.position.speed_limit_rad_s = 200.0;
  EXPECT_NEAR(compile(s)->drive.extras.position.profile.rad_s_per_part * counts_s, 180.0, 1e-6);
  s.control.mode = Mode::speed;
  EXPECT_FALSE(compile(s)->drive.extras.position.on) << "a speed is not its to shape";
}

/// The limits change during the move. Position and speed must not jump, and the move must still reach its
/// end.
TEST(PositionProfile, OtherLimitsInFlight) {
  Scenario s = move(true, FirmwareKind::field);
  s.control.position.profile.speed_rad_s.reset();
  s.control.position.speed_limit_rad_s = 100.0;
  At at;
  s.reference.value = 720.0;
  s.duration_s = 0.5;
  at.time_s = 0.08;
  at.control.position.speed_limit_rad_s = 60.0;
  s.at.push_back(at);
  ask(s, over(MetricKind::mean, Signal::position, 0.48));
  ask(s, over(MetricKind::maximum, Signal::position_error, 0.0));
  ask(s, over(MetricKind::mean, Signal::speed, 0.12, 0.15));
  const std::vector<double> f = figures_of(s);
  EXPECT_NEAR(f[0], 720.0, 0.05);
  EXPECT_LT(f[1], 3.0);
  EXPECT_NEAR(f[2], 54.0, 0.5);
}

TEST(PositionProfile, TheErrorIsThatOfTheProfile) {
  Scenario s = move(true);
  ask(s, over(MetricKind::final_value, Signal::position_reference, 0.0, 0.08));
  ask(s, over(MetricKind::final_value, Signal::position_reference, 0.9));
  const std::vector<double> f = figures_of(s);
  EXPECT_NEAR(f[0], v * (0.08 - (v / a + smoothing) / 2) * degrees, v * 1e-3 * degrees) << "on its way";
  EXPECT_EQ(f[1], way_deg);
}

std::string told(const Scenario& s) {
  base::Problems problems = check(s);
  if (problems.empty()) {
    const auto compiled = compile(s);
    if (compiled) return "";
    problems = compiled.problems();
  }
  return base::to_string(problems.front());
}

TEST(PositionProfile, ContradictionsAreTold) {
  const auto with = [](auto change) {
    Scenario s = move(true);
    change(s.control);
    return told(s);
  };
  EXPECT_EQ(with([](Control&) {}), "");
  EXPECT_THAT(with([](Control& c) { c.position.profile.jerk_rad_s3 = 1e6; }),
              HasSubstr("control.position.profile.smoothing_s = 0.005 contradicts jerk_rad_s3"));
  EXPECT_THAT(
      with([](Control& c) { c.position.speed_limit_rad_s = 80.0; }),
      HasSubstr(
          "control.position.profile.speed_rad_s = 100 is above control.position.speed_limit_rad_s = 80"));
  EXPECT_THAT(with([](Control& c) { c.slew = 10.0; }),
              HasSubstr("control.slew = 10 limits the rate of the setpoint"));
  EXPECT_THAT(with([](Control& c) { c.arithmetic = Arithmetic::q31; }),
              HasSubstr("control.arithmetic = q31 has a resolution that is too coarse for"));
  EXPECT_THAT(with([](Control& c) { c.speed.law = study::SpeedLaw::disturbance_rejection; }),
              HasSubstr("would estimate as a load"));
  EXPECT_EQ(with([](Control& c) {
              c.speed.law = study::SpeedLaw::disturbance_rejection;
              c.position.profile.feed_forward = false;
            }),
            "");
  EXPECT_THAT(
      with([](Control& c) { c.position.profile.acceleration_rad_s2 = 6e4; }),
      HasSubstr(
          "acceleration_rad_s2 = 60000 needs a torque J a = 0.81 N m, and the drive's torque limit is 0.78 N m"));
  EXPECT_THAT(with([](Control& c) { c.position.profile.speed_rad_s = 800.0; }),
              HasSubstr("is above the no-load speed of the bus, 716 rad/s"));
  EXPECT_THAT(with([](Control& c) { c.position.profile.smoothing_s = 1000.0; }),
              HasSubstr("lower this value"));
}

}  // namespace SIXSTEP_TEST_FILE
