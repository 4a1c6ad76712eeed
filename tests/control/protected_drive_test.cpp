// SPDX-License-Identifier: Apache-2.0
// The product's drive with register inputs. With a simple motor model, the drive passes through all its
// activities.
#include "sixstep/control/protected_drive.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/control/gates.hpp"
#include "tests/control/product.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep::control;

static_assert(std::is_trivially_copyable_v<ProtectedState<double>> &&
              std::is_trivially_copyable_v<ProtectedState<Q15>> &&
              std::is_trivially_copyable_v<ProtectedConfig<Q15>>);

template <class Scalar>
class Product : public ::testing::Test {};
TYPED_TEST_SUITE(Product, Scalars);

TYPED_TEST(Product, DefaultsNeverTurnTheBridgeOn) {
  using S = TypeParam;
  ProtectedState<S> state;
  ProtectedTelemetry<S> telemetry;
  for (int n = 0; n < 1000; ++n) {
    const BridgeCommand<S> c =
        protected_step(ProtectedConfig<S>{}, state, BoardInput{.hall_pins = 0b100},
                       Request{.run = true, .clear = n % 2 == 0}, Setpoint<S>{S(1.0)}, telemetry);
    EXPECT_FALSE(c.enabled);
  }
}

TYPED_TEST(Product, CalibratesRunsBrakesAndLetsGo) {
  using S = TypeParam;
  Plant<S> p;
  p.ticks(5);
  EXPECT_EQ(p.telemetry.activity, Activity::off);
  p.request.run = true;
  p.setpoint = 200 / base_rad_s;
  p.tick();
  EXPECT_EQ(p.telemetry.activity, Activity::calibrate);
  EXPECT_FALSE(p.command.enabled);
  p.ticks(18);
  EXPECT_EQ(p.telemetry.activity, Activity::run);
  EXPECT_EQ(p.state.current_adc[1].offset_eighths, 8 * 2055);
  // The integral makes the mean of the estimated speed equal to the setpoint. The estimate resolves a
  // sector's time of 654 us to 1 us, which is 0.31 rad/s of 200 rad/s. The estimate is updated once per
  // sector, so the speed varies by dw, some rad/s. The mean of 1/time differs from the mean of the speed by
  // dw^2/w: 0.1 rad/s for dw = 4 rad/s.
  const auto mean_speed = [&p] {
    p.ticks(8000);
    double sum = 0;
    for (int n = 0; n < 8000; ++n) p.tick(), sum += p.motor.w;
    return sum / 8000;
  };
  EXPECT_NEAR(mean_speed(), 200, 0.41);
  EXPECT_EQ(p.telemetry.faults, 0);
  p.setpoint = -200 / base_rad_s;
  EXPECT_NEAR(mean_speed(), -200, 0.41) << "reversal";
  EXPECT_EQ(p.telemetry.faults, 0);
  p.request.run = false;
  p.tick();
  EXPECT_EQ(p.telemetry.activity, Activity::brake);
  for (int n = 0; n < 20000 && p.telemetry.activity == Activity::brake; ++n) p.tick();
  EXPECT_EQ(p.telemetry.activity, Activity::off);
  EXPECT_FALSE(p.command.enabled);
  // The brake ends when the estimated speed is 5 rad/s. Between edges, the estimate is only an upper bound of
  // the speed.
  EXPECT_LE(std::fabs(p.motor.w), 5.0);
}

TYPED_TEST(Product, AHallFaultStopsTheBridgeWithinATickAndNamesTheLine) {
  using S = TypeParam;
  int named = 0;
  for (int line = 1; line <= 3; ++line)
    for (const bool high : {false, true}) {
      Plant<S> p;
      p.request.run = true;
      p.setpoint = 200 / base_rad_s;
      p.ticks(4000);
      ASSERT_EQ(p.telemetry.activity, Activity::run);
      const auto bit = static_cast<std::uint8_t>(0b1000u >> line);
      (high ? p.stuck_high : p.stuck_low) = bit;
      int n = 0;
      for (; n < 400 && p.telemetry.faults == 0; ++n) {
        const std::uint8_t pins = p.registers().hall_pins;
        p.tick();
        if (sector_of_hall(pins) == no_sector) {
          EXPECT_FALSE(p.command.enabled) << "the very tick";
        }
      }
      EXPECT_EQ(p.telemetry.first_fault, fault_hall) << line;
      EXPECT_EQ(p.telemetry.activity, Activity::fault);
      EXPECT_TRUE(p.telemetry.hall_line == line || p.telemetry.hall_line == 0);
      named += p.telemetry.hall_line == line;
      // Recovery: the line is repaired and the fault is cleared. The request to run is withdrawn and set
      // again.
      p.stuck_low = p.stuck_high = 0;
      p.ticks(3);
      p.request = {.run = true, .clear = true};
      p.ticks(3);
      EXPECT_EQ(p.telemetry.activity, Activity::off);
      p.request = {};
      p.tick();
      p.request.run = true;
      p.ticks(30);
      EXPECT_EQ(p.telemetry.activity, Activity::run);
    }
  EXPECT_GE(named, 5) << "of six: a false edge late in its sector cannot be told from a rotor's";
}

TYPED_TEST(Product, AWronglyWiredRotorFailsTheAlignment) {
  using S = TypeParam;
  Plant<S> p;
  p.config.align = {S(2 / base_A), 100, 10, 0};
  p.request.run = true;
  p.motor.theta_e = 1.5;  // the angle to which the pair of sector 0 turns the rotor
  p.ticks(25);
  EXPECT_EQ(p.telemetry.activity, Activity::align);
  EXPECT_EQ(p.command.pair, positive_pair(0));
  EXPECT_TRUE(p.command.enabled);
  Plant<S> wrong = p;
  p.motor.theta_e = wrong.motor.theta_e = 1.5;
  for (int n = 0; n < 11; ++n) {
    p.motor.w = 0, p.motor.i = 0, p.motor.theta_e = 1.5;
    p.tick();
  }
  EXPECT_EQ(p.telemetry.activity, Activity::run);
  for (int n = 0; n < 105; ++n) {
    wrong.motor.w = 0, wrong.motor.i = 0, wrong.motor.theta_e = 4.5;
    wrong.tick();
  }
  EXPECT_EQ(wrong.telemetry.activity, Activity::fault);
  EXPECT_TRUE(wrong.telemetry.faults & (fault_align | fault_hall));
}

TYPED_TEST(Product, RunsOnOneShunt) {
  using S = TypeParam;
  Plant<S> p;
  p.config.sensing = CurrentSensing::one_shunt;
  p.config.shunt = {S(0.05), 0, S(0.9)};
  p.request.run = true;
  p.setpoint = 200 / base_rad_s;
  p.ticks(8000);
  double speed = 0, worst = 0;
  for (int n = 0; n < 8000; ++n) {
    const double i = p.motor.i;  // the current of the tick's sample
    p.tick();
    speed += p.motor.w / 8000;
    if (p.state.shunt.hidden == 0)
      worst =
          std::fmax(worst, std::fabs(static_cast<double>(p.telemetry.drive.motor_current_A) * base_A - i));
  }
  EXPECT_EQ(p.telemetry.faults, 0);
  EXPECT_NEAR(speed, 200, 0.41) << "as with phase currents";
  // The error is half a count of 9.8 mA in the sample, 1/16 of a count in the offset, and two roundings of
  // the scalar.
  EXPECT_LE(worst, 40.0 / 4096 * (0.5 + 0.0625) + 2 * digit<S>() * base_A);
}

TYPED_TEST(Product, AdvanceCommutatesBeforeTheEdge) {
  using S = TypeParam;
  Plant<S> p;
  p.request.run = true;
  p.setpoint = 200 / base_rad_s;
  p.ticks(6000);
  p.config.advance = {S(0.25), Gain<S>(0.0), S(0.4)};
  int early = 0, present = 0;
  for (int n = 0; n < 500; ++n) {
    const int s = p.motor.sector();
    const double way = p.motor.theta_e - s;
    p.motor.w = 200;  // constant, as with a large inertia: the last sector's time is valid for the present
                      // sector
    p.tick();
    if (!p.command.enabled || p.motor.sector() != s) continue;
    const Pair pair = p.state.drive.reversed ? swapped(p.command.pair) : p.command.pair;
    // A tick is 5 % of a sector, and this motor model rounds the time of an edge to the end of the tick.
    if (way > 0.8 && way < 0.95) {
      EXPECT_EQ(pair, positive_pair(static_cast<std::uint8_t>((s + 1) % 6)));
      ++early;
    } else if (way > 0.05 && way < 0.7) {
      EXPECT_EQ(pair, positive_pair(static_cast<std::uint8_t>(s % 6)));
      ++present;
    }
  }
  EXPECT_GT(early, 30);
  EXPECT_GT(present, 200);
}

}  // namespace SIXSTEP_TEST_FILE
