// SPDX-License-Identifier: Apache-2.0
#include "sixstep/control/drive.hpp"

#include <gtest/gtest.h>

#include <random>
#include <type_traits>

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

template <class Scalar>
struct Bench {
  DriveConfig<Scalar> config{};
  DriveState<Scalar> state{};
  Measurement<Scalar> measured{.hall = 0b100};
  Telemetry<Scalar> telemetry{};
  constexpr BridgeCommand<Scalar> tick(Scalar setpoint) {
    return step(config, state, measured, Setpoint<Scalar>{setpoint}, telemetry);
  }
};

static_assert(std::is_trivially_copyable_v<DriveState<float>>);
static_assert(std::is_trivially_copyable_v<DriveState<double>>);
static_assert(std::is_trivially_copyable_v<DriveConfig<float>>);
static_assert(std::is_trivially_copyable_v<BridgeCommand<float>>);

TEST(Drive, DefaultsLeaveTheBridgeOff) {
  Bench<double> b;
  EXPECT_FALSE(b.tick(1.0).enabled);
  EXPECT_FALSE(b.tick(1.0).fault);
  EXPECT_FALSE(on_hall(b.config, b.state, std::uint8_t{0b110}).enabled);
  EXPECT_FALSE(BridgeCommand<float>{}.enabled);
}

TEST(Drive, ForgottenGainsGiveNoDuty) {
  for (const Mode mode : {Mode::current, Mode::speed, Mode::position}) {
    Bench<double> b;
    b.config.mode = mode;
    b.config.nominal_bus_V = 24.0;
    EXPECT_EQ(b.tick(1.0).duty, 0.0);
  }
}

TEST(Drive, ANegativeDutySwapsThePairAndZeroCountsAsPositive) {
  for (std::uint8_t sector = 0; sector < 6; ++sector) {
    constexpr std::uint8_t code[] = {0b100, 0b110, 0b010, 0b011, 0b001, 0b101};
    Bench<double> b;
    b.config.mode = Mode::duty;
    b.measured.hall = code[sector];
    EXPECT_EQ(b.tick(0.3).pair, positive_pair(sector));
    EXPECT_EQ(b.tick(0.0).pair, positive_pair(sector));
    EXPECT_EQ(b.tick(-0.0).pair, positive_pair(sector)) << "negative zero is zero";
    const BridgeCommand<double> back = b.tick(-0.3);
    EXPECT_EQ(back.pair, swapped(positive_pair(sector)));
    EXPECT_EQ(back.duty, 0.3);
    EXPECT_EQ(b.telemetry.duty, -0.3);
  }
}

TEST(Drive, DutyIsClampedToOne) {
  Bench<double> b;
  b.config.mode = Mode::duty;
  EXPECT_EQ(b.tick(7.0).duty, 1.0);
  EXPECT_EQ(b.tick(-7.0).duty, 1.0);
}

TEST(Drive, AnImpossibleHallCodeTurnsOffAndIsReported) {
  for (const std::uint8_t code : {std::uint8_t{0b000}, std::uint8_t{0b111}}) {
    Bench<double> b;
    b.config.mode = Mode::duty;
    b.tick(0.5);
    EXPECT_TRUE(on_hall(b.config, b.state, code).fault);
    EXPECT_FALSE(b.state.command.enabled);
    b.measured.hall = code;
    EXPECT_TRUE(b.tick(0.5).fault);
    EXPECT_FALSE(b.tick(0.5).enabled);
    b.measured.hall = 0b100;
    EXPECT_TRUE(b.tick(0.5).enabled) << "a good code again: a good command again";
    EXPECT_FALSE(b.tick(0.5).fault);
  }
}

TEST(Drive, OnHallMovesTheStateAndKeepsDutyAndSign) {
  for (const double d : {0.4, -0.4}) {
    Bench<double> b;
    b.config.mode = Mode::duty;
    const BridgeCommand<double> before = b.tick(d);
    BridgeCommand<double> after = on_hall(b.config, b.state, std::uint8_t{0b110});
    EXPECT_EQ(after.pair, d > 0 ? positive_pair(1) : swapped(positive_pair(1)));
    after.pair = before.pair;
    EXPECT_EQ(after, before) << "nothing but the pair changes";
  }
}

TEST(Drive, CurrentLoopDividesByTheNominalBus) {
  Bench<double> b;
  b.config.mode = Mode::current;
  b.config.current = {4.5, -4.0, 24.0};
  b.config.nominal_bus_V = 24.0;
  b.measured = {.i_a_A = 1.5, .i_b_A = -0.5, .i_c_A = -1.0, .bus_V = 30.0, .hall = 0b100};
  EXPECT_EQ(b.tick(3.0).duty, 4.5 * (3.0 - 1.0) / 24.0);  // i_m = (1.5 + 0.5)/2
  EXPECT_EQ(b.telemetry.motor_current_A, 1.0);
  EXPECT_EQ(b.telemetry.current_reference_A, 3.0);
  const BridgeCommand<double> back = b.tick(-9.0);
  EXPECT_EQ(back.pair, swapped(positive_pair(0)));
  EXPECT_EQ(back.duty, 1.0);  // 9 - 45 - 8, clamped at 24
}

Bench<double> cascade(Mode mode) {
  Bench<double> b;
  b.config.mode = mode;
  b.config.current = {1.0, 0.0, 24.0};
  b.config.nominal_bus_V = 24.0;
  b.config.speed = {0.01, 0.0, 1.0};
  b.config.current_at_full_torque_A = 20.0;
  b.config.current_limit_A = 8.0;
  b.config.position_gain = 2.0;
  b.config.speed_limit_rad_s = 30.0;
  return b;
}

TEST(Drive, CascadeRunsOuterToInnerFromOneSample) {
  Bench<double> b = cascade(Mode::position);
  b.measured.position_deg = 10.0;
  b.measured.speed_rad_s = 5.0;
  b.tick(20.0);
  EXPECT_EQ(b.telemetry.speed_reference_rad_s, 20.0);                      // 2 * (20 - 10)
  EXPECT_EQ(b.telemetry.current_reference_A, 0.01 * (20.0 - 5.0) * 20.0);  // computed in the same tick
  EXPECT_EQ(b.telemetry.duty, b.telemetry.current_reference_A / 24.0);
}

TEST(Drive, CascadeLimitsEachReference) {
  Bench<double> b = cascade(Mode::position);
  b.tick(1000.0);
  EXPECT_EQ(b.telemetry.speed_reference_rad_s, 30.0);
  for (int n = 0; n < 10; ++n) b.tick(-1000.0);
  EXPECT_EQ(b.telemetry.speed_reference_rad_s, -30.0);
  EXPECT_EQ(b.telemetry.current_reference_A, -8.0);
  EXPECT_EQ(b.state.speed.u, -1.0) << "the speed loop's own limit, the fraction of torque";
}

TEST(Drive, SpeedModeTakesTheSetpointAsSpeed) {
  Bench<double> b = cascade(Mode::speed);
  b.measured.speed_rad_s = 10.0;
  b.tick(20.0);
  EXPECT_EQ(b.telemetry.current_reference_A, 0.01 * 10.0 * 20.0);
}

TEST(Drive, SampledHysteresisIsAllOrNothing) {
  Bench<double> b;
  b.config.mode = Mode::current;
  b.config.current_control = CurrentControl::hysteresis;
  b.config.hysteresis = {0.2, Watch::none};
  EXPECT_EQ(b.tick(5.0).duty, 1.0);
  b.measured.i_a_A = 5.3;
  b.measured.i_b_A = -5.3;
  EXPECT_EQ(b.tick(5.0).duty, 0.0);
  EXPECT_EQ(b.tick(5.0).pair, positive_pair(0));
  const BridgeCommand<double> back = b.tick(-5.0);  // s i_m = -5.3, far below the setpoint
  EXPECT_EQ(back.duty, 1.0);
  EXPECT_EQ(back.pair, swapped(positive_pair(0)));
}

TEST(Drive, EventHysteresisArmsTheBoardsComparators) {
  Bench<double> b;
  b.config.mode = Mode::current;
  b.config.current_control = CurrentControl::hysteresis;
  b.config.hysteresis = {0.25, Watch::motor};
  const BridgeCommand<double> on = b.tick(-5.0);
  EXPECT_EQ(on.watch, Watch::motor);
  EXPECT_EQ(on.on_below_A, 4.75);
  EXPECT_EQ(on.off_above_A, 5.25);
  EXPECT_EQ(on.pair, swapped(positive_pair(0)));
  EXPECT_EQ(b.tick(0.0).pair, positive_pair(0)) << "sign(0) = +1";
}

constexpr double constexpr_duty() {
  Bench<double> b;
  b.config.mode = Mode::duty;
  b.tick(-0.5);
  return on_hall(b.config, b.state, std::uint8_t{0b110}).duty;
}
static_assert(constexpr_duty() == 0.5);

TEST(Drive, FloatFollowsDouble) {
  Bench<double> d = cascade(Mode::speed);
  Bench<float> f;
  f.config = {.mode = Mode::speed,
              .current = {1.0f, 0.0f, 24.0f},
              .nominal_bus_V = 24.0f,
              .speed = {0.01f, 0.0f, 1.0f},
              .current_at_full_torque_A = 20.0f,
              .current_limit_A = 8.0f};
  std::mt19937_64 random{5};
  std::uniform_real_distribution<double> any(-1, 1);
  for (int n = 0; n < 100; ++n) {
    const float w = static_cast<float>(50 * any(random)), r = static_cast<float>(50 * any(random));
    f.measured.speed_rad_s = w;
    d.measured.speed_rad_s = w;
    const float a = f.tick(r).duty;
    const double b = d.tick(r).duty;
    // The terms are up to 24 V. Each sample rounds a few times, and the integral sums the errors.
    EXPECT_NEAR(a, b, (n + 1) * 8 * 0x1p-23) << n;
  }
}

}  // namespace SIXSTEP_TEST_FILE
