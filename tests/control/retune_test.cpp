// SPDX-License-Identifier: Apache-2.0
// The configuration changes between two ticks. Some states continue, other states start at rest.
#include "sixstep/control/retune.hpp"

#include <gtest/gtest.h>

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

DriveConfig<double> cascade() {
  DriveConfig<double> c;
  c.mode = Mode::speed;
  c.current = {2.0, -1.5, 24.0};
  c.nominal_bus_V = 24.0;
  c.speed = {0.02, -0.018, 1.0};
  c.current_at_full_torque_A = 10.0;
  c.current_limit_A = 10.0;
  return c;
}

Measurement<double> turning(double speed, double current) {
  // The test sets the current of the driven pair. The Hall code of sector 0 determines this pair.
  const std::uint8_t code = hall_of_sector(0);
  Measurement<double> m{.speed_rad_s = speed, .bus_V = 24.0, .hall = code};
  set_phase_currents(m, positive_pair(0), current);
  return m;
}

double duty_of(const DriveState<double>& s) { return s.reversed ? -s.command.duty : s.command.duty; }

/// The output u follows u[n] - u[n-1] = d1 (e[n] - e[n-1]) + K_i e[n-1] with the new gains and the error e.
/// Without an error, the output is constant.
TEST(Retune, AVelocityPiGoesOnFromItsLastOutput) {
  DriveConfig<double> config = cascade();
  config.mode = Mode::current;
  DriveState<double> state;
  Telemetry<double> telemetry;
  for (const double i : {0.0, 1.0, 1.5}) step(config, state, turning(0.0, i), {2.0}, telemetry);
  const double before = state.current.u, error = state.current.e;
  EXPECT_EQ(error, 0.5);
  DriveConfig<double> next = config;
  next.current = {5.0, -4.8, 24.0};
  retune(config, state, next);
  EXPECT_EQ(state.current.u, before);
  step(config, state, turning(0.0, 1.75), {2.0}, telemetry);
  EXPECT_NEAR(state.current.u, before + 5.0 * (0.25 - 0.5) + 0.2 * 0.5, 4 * 0x1p-52 * 24.0);
  // The current is at its reference for two ticks. Then the output does not change, for any gains.
  step(config, state, turning(0.0, 2.0), {2.0}, telemetry);
  step(config, state, turning(0.0, 2.0), {2.0}, telemetry);
  const double settled = duty_of(state);
  next.current = {0.3, -0.29, 24.0};
  retune(config, state, next);
  step(config, state, turning(0.0, 2.0), {2.0}, telemetry);
  EXPECT_EQ(duty_of(state), settled);
}

TEST(Retune, ALoopThatBothModesRunKeepsItsState) {
  DriveConfig<double> config = cascade();
  DriveState<double> state;
  Telemetry<double> telemetry;
  for (int n = 0; n < 5; ++n) step(config, state, turning(90.0, 0.5 * n), {100.0}, telemetry);
  const PiState<double> current = state.current, speed = state.speed;
  DriveConfig<double> next = config;
  next.mode = Mode::current;
  retune(config, state, next);
  EXPECT_EQ(state.current.u, current.u);
  EXPECT_EQ(state.current.e, current.e);
  EXPECT_EQ(config.mode, Mode::current);
  // The mode changes back to position. The speed loop was inactive in between, so it starts at rest.
  next.mode = Mode::position;
  retune(config, state, next);
  EXPECT_EQ(state.speed.u, 0.0);
  EXPECT_EQ(state.speed.e, 0.0);
  EXPECT_EQ(state.current.u, current.u);
  EXPECT_NE(speed.u, 0.0);
}

TEST(Retune, FromDutyOrOffTheLoopsBeginAtRest) {
  for (const Mode idle : {Mode::duty, Mode::off}) {
    DriveConfig<double> config = cascade(), other = cascade();
    DriveState<double> state;
    Telemetry<double> telemetry;
    for (int n = 0; n < 5; ++n) step(config, state, turning(90.0, 0.5 * n), {100.0}, telemetry);
    other.mode = idle;
    retune(config, state, other);
    step(config, state, turning(90.0, 0.0), {0.4}, telemetry);
    EXPECT_EQ(duty_of(state), idle == Mode::duty ? 0.4 : 0.0);
    retune(config, state, cascade());
    EXPECT_EQ(state.current.u, 0.0);
    EXPECT_EQ(state.speed.u, 0.0);
    EXPECT_EQ(duty_of(state), idle == Mode::duty ? 0.4 : 0.0) << "the last command stands until the tick";
  }
}

TEST(Retune, ASlewedSetpointStartsAtWhatIsMeasured) {
  DriveConfig<double> config = cascade();
  config.extras.on = config.extras.slews_setpoint = true;
  config.extras.slew.step = 0.25;
  DriveState<double> state;
  Telemetry<double> telemetry;
  for (int n = 0; n < 5; ++n) step(config, state, turning(90.0, 3.0), {100.0}, telemetry);
  DriveConfig<double> next = config;
  next.mode = Mode::current;
  retune(config, state, next);
  step(config, state, turning(90.0, 3.0), {8.0}, telemetry);
  EXPECT_EQ(telemetry.current_reference_A, 3.25);
}

TEST(Retune, ABrakingProductKeepsTheLoopThatBrakes) {
  ProtectedConfig<double> config;
  config.drive = cascade();
  config.drive.mode = Mode::duty;
  ProtectedState<double> state;
  state.drive.current.u = 3.0;
  ProtectedConfig<double> next = config;
  next.drive.mode = Mode::speed;
  for (const Activity activity : {Activity::brake, Activity::run}) {
    ProtectedConfig<double> taken = config;
    state.activity.activity = activity;
    retune(taken, state, next);
    EXPECT_EQ(taken, next);
    EXPECT_EQ(state.drive.current.u, activity == Activity::brake ? 3.0 : 0.0);
  }
}

}  // namespace SIXSTEP_TEST_FILE
