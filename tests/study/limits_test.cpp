// SPDX-License-Identifier: Apache-2.0
// In the full switching simulation, current, speed and bus stay within their limits. Unreachable limits are
// refused. tests/fuzz/limits_test.cpp tests limits with random scenarios.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/study/check/check.hpp"
#include "sixstep/study/compile/basis.hpp"
#include "tests/support/product_scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::Chopping;
using control::Mode;
using study::Arithmetic;
using study::MetricKind;
using study::Scenario;
using study::Signal;
using ::testing::HasSubstr;

double figure(Scenario s, MetricKind metric, Signal signal, double from_s = 0.0) {
  study::Measure m = measure(metric, signal);
  m.from_s = from_s;
  s.compare = {{m, 0.0, ""}};
  const auto out = study::run(s);
  if (!out) ADD_FAILURE() << to_string(out.problems()[0]);
  return out ? out->comparisons[0].measured : NAN;
}

std::string refusal(const Scenario& s) {
  const auto out = study::run(s);
  return out ? "not refused" : to_string(out.problems()[0]);
}

/// The setpoint is full current. If a sample is at the ripple's minimum of 0 A, the speed limit permits short
/// pulses, which still drive the rotor.
TEST(Limits, OwnTorqueStaysWithinTheLimitOfSpeedInEveryChopping) {
  for (const Chopping chopping : {Chopping::soft, Chopping::hard, Chopping::complementary}) {
    Scenario s = maxon_scenario(Mode::current, 6.99);
    s.duration_s = 0.3;
    s.pwm.period_s = 20e-6;
    s.pwm.chopping = chopping;
    s.control.limits = {.current_A = 6.99, .speed_rad_s = 286.6};
    const double free = figure(s, MetricKind::final_value, Signal::speed);
    EXPECT_GT(free, 285.0) << "it does go there";
    const double most = figure(s, MetricKind::maximum, Signal::speed);
    std::printf("limit 286.6 rad/s, at most %.6g\n", most);
    EXPECT_LE(most, 286.6 + 0.0335 * 6.99 / 1.35e-5 * 20e-6) << "one period of its torque";
  }
}

/// The rotor brakes at full current, and the bus cannot sink the energy.
Scenario braking(Chopping chopping) {
  Scenario s = maxon_scenario(Mode::current, -5.0);
  s.duration_s = 0.1;
  s.pwm.chopping = chopping;
  s.initial.speed_rad_s = 600.0;
  s.load.inertia_kg_m2 = 1e-4;
  s.supply = {.voltage_V = 24.0, .resistance_ohm = 0.1, .capacitance_F = 10e-3, .sinks = false};
  s.control.regeneration.limit_V = 30.0;
  return s;
}

TEST(Limits, TheBusStaysWithinItsBoundInEveryChopping) {
  for (const Chopping chopping : {Chopping::soft, Chopping::hard, Chopping::complementary})
    for (const int delay : {0, 1}) {
      Scenario s = braking(chopping);
      s.pwm.delay_periods = delay;
      const double most = figure(s, MetricKind::maximum, Signal::bus_voltage);
      std::printf("limit 30 V, at most %.6g V\n", most);
      // The bound adds two terms to 30 V. At the limit, 6.25 A are switched off at a back-EMF of 20 V. The
      // energy of the winding raises the bus by sqrt((30 - 20)^2 + L I^2/C) - 10 V. One period of this
      // current adds I T/C.
      EXPECT_LE(most, 20 + std::sqrt(100 + 0.572e-3 * 6.25 * 6.25 / 10e-3) + 6.25 * 30e-6 / 10e-3);
    }
}

/// At 30 V, 5 A are switched off at a back-EMF of 20 V. The energy of the winding charges the 220 uF to 20 V
/// + sqrt((30 - 20)^2 + L I^2/C) = 33 V.
TEST(Limits, ABusThatCannotHoldItsLimitIsRefusedWithWhatWould) {
  Scenario s = braking(Chopping::hard);
  s.supply.capacitance_F = 220e-6;
  const std::string said = refusal(s);
  EXPECT_THAT(said, HasSubstr("control.regeneration.limit_V = 30 cannot be held"));
  EXPECT_THAT(said, HasSubstr("supply.capacitance_F to "));
  s.supply.capacitance_F = std::stod(said.substr(said.find("capacitance_F to ") + 17)) * 1.01;
  EXPECT_TRUE(study::run(s)) << "the cure cures";
}

TEST(Limits, WhatNeedsACurrentLoopIsRefusedWithoutOne) {
  Scenario s = maxon_scenario(Mode::duty, 0.5);
  s.control.limits = {.current_A = 2.0, .torque_Nm = 0.1, .speed_rad_s = 100.0};
  s.control.regeneration.limit_V = 30.0;
  s.supply = {.voltage_V = 24.0, .resistance_ohm = 0.1, .capacitance_F = 10e-3, .sinks = false};
  EXPECT_EQ(study::check(s).size(), 4u);
}

TEST(Limits, ACurrentThatOnePulsePassesIsRefused) {
  Scenario s = maxon_scenario(Mode::current, 1.0);
  s.control.limits.current_A = 1.0;  // 24 V 30 us/0.572 mH = 1.26 A
  EXPECT_THAT(refusal(s), HasSubstr("one PWM period on a bus of up to 24 V drives 1.26 A"));
  s.pwm.period_s = 20e-6;
  EXPECT_TRUE(study::run(s));
}

/// A scenario with a salient rotor runs, but its limits are not guaranteed, because the bounds are not proved
/// for salient rotors. A message names each limit.
TEST(Limits, OfASalientRotorAreNotPromised) {
  Scenario s = maxon_scenario(Mode::current, 3.0);
  s.sheet.inductance_mH.reset();
  s.sheet.d_axis_inductance_mH = base::Quantity{.value = 0.24};
  s.sheet.q_axis_inductance_mH = base::Quantity{.value = 0.34};
  EXPECT_EQ(refusal(s), "not refused");
  s.control.limits.current_A = 6;
  EXPECT_THAT(refusal(s),
              HasSubstr("control.limits.current_A = 6 can be kept only for a rotor with equal L_d and L_q"));
  s.control.limits = {.speed_rad_s = 300};
  EXPECT_THAT(
      refusal(s),
      HasSubstr("control.limits.speed_rad_s = 300 can be kept only for a rotor with equal L_d and L_q"));
  EXPECT_THAT(refusal(s), HasSubstr("L_q is 1.42 times its L_d"));
}

TEST(Limits, ASpeedThatHallEdgesTellTooLateIsRefused) {
  Scenario s = maxon_scenario(Mode::current, 7.0);
  s.control.limits = {.current_A = 7.0, .speed_rad_s = 100.0};
  EXPECT_TRUE(study::run(s)) << "told at once";
  s.sensors.rotor = study::RotorSensing::hall;
  EXPECT_THAT(refusal(s), HasSubstr("control.limits.speed_rad_s = 100 cannot be held"));
}

TEST(Limits, AReferenceBeyondTheConverterIsRefused) {
  Scenario s = maxon_scenario(Mode::current, 12.0);
  s.sensors.currents = rig::CurrentMeasurement::phases;
  s.sensors.current_range_A = 10.0;
  EXPECT_THAT(refusal(s), HasSubstr("sensors.current_range_A = 10"));
  s.sensors.current_range_A = 12.1;
  EXPECT_TRUE(study::run(s));
  s.sensors.current_offset_A = 0.2;
  EXPECT_FALSE(study::run(s)) << "of one sign it ends 0.2 A earlier";
}

TEST(Limits, OneShuntHidesWhatALimitOfCurrentMustSee) {
  Scenario s = maxon_scenario(Mode::current, 2.0);
  s.control.limits.current_A = 2.0;
  s.pwm.sample = study::SampleAt::middle;
  s.sensors.currents = rig::CurrentMeasurement::dc_link;
  s.sensors.current_range_A = 20.48;
  EXPECT_THAT(refusal(s), HasSubstr("control.limits.current_A = 2 needs the current of every phase"));
}

TEST(Product, BrakingAboveOverCurrentIsRefused) {
  Scenario s = product_scenario(Mode::speed, 100.0);
  s.protection.brake_current_A = *s.protection.over_current_A;
  ASSERT_EQ(study::check(s).size(), 1u);
  EXPECT_THAT(to_string(study::check(s)[0]), HasSubstr("braking would trip the drive"));
}

TEST(Product, AThresholdBeyondTheConverterIsRefused) {
  Scenario s = product_scenario(Mode::speed, 100.0);
  s.sensors.current_offset_A = 0.1;
  s.protection.stall_s = 0.1;
  s.protection.stall_current_A = 20.3;  // 20.47, the largest reading, less the offset of 0.1
  EXPECT_TRUE(study::check(s).empty());
  for (const double beyond : {20.4, 30.0}) {
    s.protection.stall_current_A = beyond;
    ASSERT_EQ(study::check(s).size(), 1u);
    EXPECT_THAT(to_string(study::check(s)[0]), HasSubstr("protection.stall_current_A"));
  }
  s.protection.stall_current_A = 8.0;
  s.protection.over_current_A = 20.4;
  EXPECT_EQ(study::check(s).size(), 1u);
  s.protection.over_current_A = 15.0;
  s.protection.over_voltage_V = 40.955;  // the last count is 40.95
  EXPECT_EQ(study::check(s).size(), 1u);
  s.protection.over_voltage_V = 35.0;
  s.sensors.bus_offset_V = 10.0;  // equal to under_voltage_V
  EXPECT_EQ(study::check(s).size(), 1u);
}

/// While the windings are shorted, no loop runs, so no reference is shown.
TEST(Product, NoReferenceIsShownWhileTheWindingsAreShorted) {
  Scenario s = product_scenario(Mode::speed, 100.0);
  s.duration_s = 0.12;
  s.protection.brake_current_A = 2.0;
  s.protection.short_below_rad_s = 1000.0;
  s.protection.standing_rad_s = 5.0;
  s.protection.off_at_s = 0.1;
  for (const Signal signal : {Signal::current_reference, Signal::speed_reference})
    EXPECT_EQ(figure(s, MetricKind::peak_to_peak, signal, 0.1002), 0.0);
  EXPECT_EQ(figure(s, MetricKind::maximum, Signal::speed_reference, 0.1002), 0.0);
}

/// If the line breaks just after one of its edges, the next edge is false. The sector between both edges may
/// then be arbitrarily short, and the measured speed arbitrarily high. The drive must report the line, not
/// over-speed.
TEST(Product, ABrokenHallLineIsNoOverSpeed) {
  Scenario s = product_scenario(Mode::speed, 100.0);
  s.protection.over_speed_rad_s = 300.0;
  s.duration_s = 0.34;
  int named = 0, runs = 0;
  for (int n = 0; n < 60; ++n)
    for (const int line : {1, 2, 3}) {
      // A turn of 6 sectors takes 7.85 ms.
      s.sensors.hall_break = {.at_s = 0.3 + n * 7.85e-3 / 60,
                              .line = line,
                              .level = n % 2 ? study::Level01::low : study::Level01::high};
      const auto out = study::run(s);
      ASSERT_TRUE(out && out->fault) << n << ' ' << line;
      EXPECT_THAT(out->fault->limit, HasSubstr("Hall")) << n << ' ' << line;
      const std::size_t at = out->fault->limit.find("line H");
      ++runs;
      if (at == std::string::npos) continue;
      EXPECT_THAT(out->fault->limit, HasSubstr("line H" + std::to_string(line))) << n;
      ++named;
    }
  std::printf("named %d of %d\n", named, runs);
  EXPECT_GT(named, runs * 9 / 10);
}

/// At the start, K e is 19 (gain K, error e). The range of the format ends at 16 times the output.
TEST(SpeedForm, FixedPointWindsUpNoMoreThanDouble) {
  Scenario s = maxon_scenario(Mode::speed, 0.0);
  s.duration_s = 0.15;
  s.reference = {.shape = study::Shape::steps, .times_s = {0.0, 0.02}, .values = {0.0, 500.0}};
  s.control.speed.settle_s = 0.02;
  s.control.speed.damping = 0.9;
  s.control.speed.torque_limit_Nm = 0.1;
  s.control.speed.form = study::SpeedForm::positional;
  const double wide = figure(s, MetricKind::maximum, Signal::speed);
  EXPECT_LT(wide, 515.0);
  for (const Arithmetic a : {Arithmetic::q31, Arithmetic::q30, Arithmetic::q15, Arithmetic::q14}) {
    s.control.arithmetic = a;
    EXPECT_NEAR(figure(s, MetricKind::maximum, Signal::speed), wide, 1.0);
  }
}

/// The derivative part is kp T_d a, which is 1.8 times full torque (gain kp, derivative time T_d,
/// acceleration a).
TEST(SpeedForm, ADerivativeAboveFullTorqueIsTheSameInFixedPoint) {
  Scenario s = maxon_scenario(Mode::speed, 0.0);
  s.duration_s = 0.3;
  s.reference = {.shape = study::Shape::steps, .times_s = {0.0, 0.02}, .values = {0.0, 500.0}};
  s.control.speed.settle_s = 0.1;
  s.control.speed.damping = 0.9;
  s.control.speed.torque_limit_Nm = 0.1;
  s.control.speed.form = study::SpeedForm::positional;
  s.control.speed.derivative_s = 20e-3;
  const double wide = figure(s, MetricKind::maximum, Signal::speed);
  for (const Arithmetic a : {Arithmetic::q31, Arithmetic::q30}) {
    s.control.arithmetic = a;
    EXPECT_NEAR(figure(s, MetricKind::maximum, Signal::speed), wide, 0.5);
  }
  s.control.speed.anti_windup = 1.0;  // the integral follows u - K e, 15 times the output
  s.control.arithmetic = Arithmetic::q31;
  EXPECT_THAT(refusal(s), HasSubstr("speed derivative and integral"));
  s.control.speed.anti_windup = 0.0;
  EXPECT_THAT(refusal(s), HasSubstr("lets the integral grow without a limit"));
  s.control.speed.anti_windup = std::nullopt;
  s.sensors.rotor = study::RotorSensing::hall;  // the speed from Hall edges may change by the full range in
                                                // one step
  EXPECT_THAT(refusal(s), HasSubstr("a longer filter of the derivative"));
}

}  // namespace SIXSTEP_TEST_FILE
