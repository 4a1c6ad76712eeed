// SPDX-License-Identifier: Apache-2.0
// Tests the position loop with a profile: its feed-forward, its start, and the effect of another
// configuration.
#include "sixstep/control/profiled_position.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/control/field/field_drive.hpp"
#include "sixstep/control/retune.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

constexpr double T = 50e-6;

DriveConfig<double> positioning(bool feed_forward = true) {
  DriveConfig<double> c;
  c.mode = Mode::position;
  c.current = {2.0, -1.5, 24.0};
  c.nominal_bus_V = 24.0;
  c.speed = {0.02, -0.018, 1.0};
  c.current_at_full_torque_A = 10.0;
  c.current_limit_A = 10.0;
  c.position_gain = 0.5;
  c.speed_limit_rad_s = 300.0;
  c.extras.on = true;
  c.extras.position = {true, jerk_profile({100.0, 5000.0, 5e-3}, T), {feed_forward, 1e-4, 2e-4, 0.01}};
  return c;
}

struct Bench {
  DriveConfig<double> config;
  DriveState<double> state{};
  Telemetry<double> telemetry{};
  Measurement<double> measured{.bus_V = 24.0, .hall = 0b100};

  const ProfiledMotion<double>& now() const { return state.extras.position.profile.now; }
  BridgeCommand<double> tick(double target) { return step(config, state, measured, {target}, telemetry); }
  /// Moves the shaft to the profile's position.
  void follow() {
    measured.position_deg = now().position_deg;
    measured.speed_rad_s = now().speed_rad_s;
  }
};

TEST(ProfiledPosition, SpeedIsAddedToWhatThePositionLoopAsksFor) {
  Bench with{positioning()}, without{positioning(false)};
  for (int n = 0; n < 4000; ++n) {
    for (Bench* b : {&with, &without}) {
      b->measured.position_deg = n * 0.01;
      b->tick(720.0);
      const double error = b->now().position_deg - b->measured.position_deg;
      const double ahead = b == &with ? b->now().speed_rad_s : 0.0;
      ASSERT_EQ(b->telemetry.speed_reference_rad_s, clamped(error * 0.5 + ahead, 300.0)) << n;
      ASSERT_TRUE(b->telemetry.position.profiled);
      ASSERT_EQ(b->telemetry.position.reference_deg, b->now().position_deg);
    }
  }
  EXPECT_EQ(with.now().position_deg, 720.0);
  EXPECT_EQ(with.now().speed_rad_s, 0.0);
}

/// A shaft that follows the profile exactly needs no correction, so the current reference comes from the feed-forward torque alone.
TEST(ProfiledPosition, TorqueIsAskedForBeforeAnErrorIsSeen) {
  Bench b{positioning()};
  double most = 0.0;
  b.tick(0.0);
  for (int n = 0; n < 4000; ++n) {
    b.measured.position_deg =
        b.now().position_deg;  // position of the previous tick; the profile's next value is not known yet
    DriveState<double> next = b.state;
    const ProfiledMotion<double> ahead =
        jerk_profile_step(b.config.extras.position.profile, next.extras.position.profile, 720.0);
    b.measured.position_deg = ahead.position_deg;
    b.measured.speed_rad_s = ahead.speed_rad_s;
    b.tick(720.0);
    const double y = torque_ahead(b.config.extras.position.feed_forward, ahead);
    ASSERT_NEAR(b.telemetry.current_reference_A, 10.0 * y, 1e-9) << n;
    most = std::fmax(most, std::fabs(y));
  }
  EXPECT_NEAR(most, 1e-4 * 5000 + 2e-4 * 100 + 0.01, 0.02) << "inertia, friction and Coulomb torque";
}

TEST(ProfiledPosition, BothTogetherStayWithinTheLimitAndDoNotWindUp) {
  Bench b{positioning()};
  b.config.current_limit_A = 3.0;
  b.config.speed.limit = 0.3;
  b.measured.speed_rad_s = -200.0;  // far behind
  for (int n = 0; n < 200; ++n) {
    b.tick(3600.0);
    ASSERT_LE(std::fabs(b.telemetry.current_reference_A), 3.0);
  }
  EXPECT_EQ(b.telemetry.current_reference_A, 3.0);
  b.measured.speed_rad_s = 400.0;
  b.tick(3600.0);
  EXPECT_EQ(b.telemetry.current_reference_A, -3.0) << "with the first sample";
}

TEST(ProfiledPosition, AnotherModeIsToldNothingAndTheProfileBeginsAnewBehindIt) {
  Bench b{positioning()};
  for (int n = 0; n < 1000; ++n) b.tick(720.0);
  ASSERT_GT(b.now().speed_rad_s, 50.0);
  b.measured.speed_rad_s = 70.0;
  b.measured.position_deg = 222.0;
  step_in(Mode::speed, b.config, b.state, b.measured, {70.0}, b.telemetry);
  EXPECT_EQ(b.telemetry.speed_reference_rad_s, 70.0);
  EXPECT_FALSE(b.telemetry.position.profiled);
  b.tick(720.0);
  EXPECT_NEAR(b.now().position_deg, 222.0 + 70.0 * T * 180 / 3.14159265, 1e-4);
  EXPECT_NEAR(b.now().speed_rad_s, 70.0, 1.0) << "as fast as the shaft turns";
  b.measured.hall = 0;  // a fault turns the bridge off
  b.tick(720.0);
  b.measured.hall = 0b100;
  b.measured.position_deg = 300.0;
  b.measured.speed_rad_s = 0.0;
  b.tick(720.0);
  EXPECT_NEAR(b.now().position_deg, 300.0, 1e-4);
}

TEST(ProfiledPosition, OtherLimitsInFlightMakeNoJump) {
  Bench b{positioning()};
  for (int n = 0; n < 1000; ++n) b.tick(7200.0);
  const ProfiledMotion<double> before = b.now();
  DriveConfig<double> next = b.config;
  next.extras.position.profile = jerk_profile({200.0, 3000.0, 20e-3}, T);
  retune(b.config, b.state, next);
  b.tick(7200.0);
  const double way = before.speed_rad_s * T * 180 / 3.14159265358979;
  EXPECT_NEAR(b.now().position_deg, before.position_deg + way, 1e-4);
  EXPECT_NEAR(b.now().speed_rad_s, before.speed_rad_s, 1e-3);
  // If the new configuration differs only in a gain, the profile is unchanged.
  const JerkProfileState<double> kept = b.state.extras.position.profile;
  next.position_gain = 0.7;
  retune(b.config, b.state, next);
  EXPECT_EQ(b.state.extras.position.profile.rest, kept.rest);
  EXPECT_EQ(b.state.extras.position.profile.mean[0], kept.mean[0]);
}

TEST(ProfiledPosition, WithoutOneAPositionDriveIsWhatItWas) {
  Bench plain{positioning()}, off{positioning()};
  plain.config.extras = {};
  off.config.extras.position.on = false;
  for (int n = 0; n < 500; ++n) {
    for (Bench* b : {&plain, &off}) b->measured.position_deg = n * 0.3;
    ASSERT_EQ(plain.tick(90.0), off.tick(90.0));
    ASSERT_EQ(off.telemetry.speed_reference_rad_s, clamped((90.0 - n * 0.3) * 0.5, 300.0));
    ASSERT_FALSE(off.telemetry.position.profiled);
  }
}

TEST(ProfiledPosition, OfTheFieldOrientedDriveToo) {
  FieldDriveConfig<float> config;
  config.drive.mode = Mode::position;
  config.drive.speed = {0.02f, -0.018f, 1.0f};
  config.drive.current_at_full_torque_A = config.drive.current_limit_A = 10.0f;
  config.drive.position_gain = 0.5f;
  config.drive.speed_limit_rad_s = 300.0f;
  config.drive.extras.on = true;
  config.drive.extras.torque_fraction_per_A = 0.1f;
  config.drive.extras.position.on = true;
  config.drive.extras.position.profile = jerk_profile<float>({100.0, 5000.0, 5e-3}, T);
  config.drive.extras.position.feed_forward = {true, 1e-4f, 0.0f, 0.0f};
  FieldDriveState<float> state;
  FieldDriveInput<float> input{};
  input.measured.bus_V = 24.0f;
  Telemetry<float> telemetry;
  const ProfiledMotion<float>& now = state.drive.extras.position.profile.now;
  for (int n = 0; n < 4000; ++n) {
    input.measured.position_deg = now.position_deg;
    input.measured.speed_rad_s = now.speed_rad_s;
    const float before = now.position_deg;
    field_drive_step(config, state, input, {720.0f}, telemetry);
    ASSERT_NEAR(telemetry.speed_reference_rad_s, (now.position_deg - before) * 0.5f + now.speed_rad_s, 1e-4f);
  }
  EXPECT_EQ(now.position_deg, 720.0f);
}

}  // namespace SIXSTEP_TEST_FILE
