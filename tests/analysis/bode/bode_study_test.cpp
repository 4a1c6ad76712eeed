// SPDX-License-Identifier: Apache-2.0
// The loop measured in the switching simulation is equal to the designed loop if the drive is linear.
#include "sixstep/analysis/bode/bode_study.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using analysis::BodeStudy;

study::Scenario steady_current(bool locked) {
  study::Scenario s = maxon_scenario(control::Mode::current, 5.0);
  s.load.locked = locked;
  s.duration_s = 10e-3;
  return s;
}

/// The largest |L/(factor D) - 1| over the points with |L| between `least` and `most`. L: measured loop, D:
/// designed loop.
double off_by(const BodeStudy& b, double least, double most, double factor = 1.0) {
  double worst = 0;
  std::size_t looked_at = 0;
  for (const analysis::LoopPoint& p : b.points) {
    if (p.gain < least || p.gain > most) continue;
    const design::Complex D = *b.designed_at(p.w_rad_s);
    const design::Complex L{p.gain * std::cos(p.phase_rad), p.gain * std::sin(p.phase_rad)};
    const design::Complex ratio = L / D;
    worst = std::max(worst, std::hypot(ratio.re / factor - 1, ratio.im / factor));
    ++looked_at;
  }
  EXPECT_GT(looked_at, 10u);
  return worst;
}

/// Effect of a longer pulse on the current at the next sample, divided by the effect of the same voltage
/// spread over the period. The ratio x is R T/L (resistance R, period T, inductance L). The pulse ends at d T
/// (duty d), so its effect decays for (1 - d) T. The effect of the spread voltage decays for half a period on
/// average.
double pulse_over_held(double R_ohm, double L_H, double period_s, double duty) {
  const double x = R_ohm * period_s / L_H;
  return std::exp(-(1 - duty) * x) * x / -std::expm1(-x);
}

/// The duty d at which 5 A flow through the locked rotor. The mean voltage is d U (bus voltage U), or (2 d -
/// 1) U if both switches chop.
double steady_duty(control::Chopping chopping) {
  const double part = 5 * 1.03 / 24;
  return chopping == control::Chopping::hard ? (1 + part) / 2 : part;
}

/// With a locked rotor, the plant consists of the winding and the PWM. The measured loop is the designed loop
/// times the factor of the pulse's position in the period.
void expect_the_designed(study::Scenario s) {
  SCOPED_TRACE(static_cast<int>(s.pwm.chopping));
  const auto b = analysis::study_bode(s);
  ASSERT_TRUE(b) << to_string(b.problems()[0]);
  ASSERT_TRUE(b->designed && b->figures);
  const bool delayed = s.pwm.delay_periods == 1;
  const double factor = pulse_over_held(1.03, 0.572e-3, 30e-6, steady_duty(s.pwm.chopping));
  EXPECT_LT(off_by(*b, 0.05, 30, factor), 2e-3) << delayed;
  EXPECT_LT(b->beside, 1e-3);
  for (const analysis::LoopPoint& p : b->points) EXPECT_NEAR(p.coherence, 1.0, 1e-6);
  ASSERT_TRUE(b->measured.crossover_rad_s && b->measured.phase_rad);
  EXPECT_NEAR(*b->measured.crossover_rad_s / *b->figures->crossover_rad_s, factor, 5e-3);
  EXPECT_NEAR(*b->measured.phase_rad, *b->figures->phase_rad, 2e-3);
  if (delayed) {
    EXPECT_NEAR(*b->measured.gain * factor / *b->figures->gain, 1.0, 1e-2);
  }
}

TEST(Bode, CurrentLoopOfALockedRotorIsTheDesigned) {
  EXPECT_NEAR(20 * std::log10(pulse_over_held(1.03, 0.572e-3, 30e-6, 5 * 1.03 / 24)), -0.135, 1e-3);
  for (const int delay : {0, 1})
    for (const auto chopping :
         {control::Chopping::soft, control::Chopping::hard, control::Chopping::complementary}) {
      study::Scenario s = steady_current(true);
      s.pwm.delay_periods = delay;
      s.pwm.chopping = chopping;
      if (delay == 1) s.control.current.settle_s = 2e-3;
      expect_the_designed(s);
    }
}

/// The sample is in the middle of a centred pulse. After a change of the duty, one half of the change acts
/// before the next sample, the other half after it. With x = R T/L = 0.054, one half has (1 + x/4)/2 of the
/// effect of a spread voltage, the other half (1 - x/4)/2. The measured loop therefore differs by 1.4 % in
/// the imaginary part.
TEST(Bode, ASampleInTheMiddleIsHalfAPeriodLater) {
  for (const int delay : {0, 1}) {
    study::Scenario s = steady_current(true);
    s.pwm.delay_periods = delay;
    s.pwm.sample = study::SampleAt::middle;
    s.pwm.alignment = study::Alignment::centre;
    s.pwm.chopping = control::Chopping::complementary;
    const auto b = analysis::study_bode(s);
    ASSERT_TRUE(b) << to_string(b.problems()[0]);
    ASSERT_TRUE(b->designed && b->figures && b->measured.phase_rad);
    EXPECT_LT(off_by(*b, 0.3, 30), 0.02) << delay;
    EXPECT_NEAR(*b->measured.phase_rad, *b->figures->phase_rad, 5e-3);
    // Edge-aligned pulses end before the sample if the duty is below 1/2, so the loop is not linear.
    s.pwm.alignment = study::Alignment::edge;
    const auto edge = analysis::study_bode(s);
    ASSERT_TRUE(edge) << to_string(edge.problems()[0]);
    EXPECT_FALSE(edge->designed);
    EXPECT_NE(edge->not_linear.find("edge-aligned pulses"), std::string::npos);
  }
}

/// Smooth chopping selects soft or hard chopping by the measured current. Above its thresholds, the chopping
/// is soft with the gains for one switch, for any value of pwm.chopping.
TEST(Bode, SmoothChoppingIsTheDesignedToo) {
  study::Scenario s = steady_current(true);
  s.control.smooth_chopping.on = true;
  expect_the_designed(s);
}

/// The closed loop is z^-1, or z^-2 with a delay. The pulse's position multiplies the voltage by f =
/// pulse_over_held(), and the prediction corrects only slow errors. The measured loop is therefore between
/// the designed loop and f times the designed loop.
TEST(Bode, ADeadbeatLoopIsADelay) {
  for (const int delay : {0, 1, 2}) {
    study::Scenario s = steady_current(true);
    s.pwm.delay_periods = delay % 2;
    s.pwm.chopping = delay == 2 ? control::Chopping::hard : control::Chopping::complementary;
    s.control.current.type = study::CurrentLoopType::deadbeat;
    // The gain is 19 V per ampere and period. A larger amplitude would need more than the bus voltage.
    const auto b = analysis::study_bode(s, {.amplitude = 0.02});
    ASSERT_TRUE(b) << to_string(b.problems()[0]);
    ASSERT_TRUE(b->designed);
    const double f = pulse_over_held(1.03, 0.572e-3, 30e-6, steady_duty(s.pwm.chopping));
    EXPECT_LT(off_by(*b, 0.5, 30), 1.5 * std::fabs(1 - f)) << delay;
    for (const analysis::LoopPoint& p : b->points)
      EXPECT_NEAR(std::sqrt(p.closed.square()), 1.0, 3 * std::fabs(1 - f))
          << "2.3 (1 - f) at half the sampling rate";
  }
}

/// With both switches chopped, the current may reverse, so the speed loop is linear apart from commutation.
/// The torque is proportional to the mean current, but the controller measures a sample of the current. Near
/// the crossover, the gain therefore differs by 1 to 2 % from the linear loop.
TEST(Bode, SpeedLoopIsTheDesigned) {
  for (const auto chopping : {control::Chopping::complementary, control::Chopping::hard}) {
    study::Scenario s = cascade(0.1);
    s.pwm.chopping = chopping;
    // Hard chopping prevents a negative current, so a load is needed to keep the current continuous.
    if (chopping == control::Chopping::hard) s.load.torque_Nm = 0.1;
    const auto b = analysis::study_bode(s);
    ASSERT_TRUE(b) << to_string(b.problems()[0]);
    ASSERT_TRUE(b->figures && b->measured.crossover_rad_s && b->measured.phase_rad);
    EXPECT_NEAR(*b->measured.crossover_rad_s / *b->figures->crossover_rad_s, 1.0, 0.05);
    EXPECT_NEAR(*b->measured.phase_rad, *b->figures->phase_rad, 0.03);
    EXPECT_LT(off_by(*b, 0.3, 5), 0.08);
  }
}

/// Each speed law gives the closed loop of its design rule, T = (1 - p)/(z - p) with the pole p. Without the
/// delay of the current loop, the open loop is L = (1 - p)/(z - 1). Its crossover is 2 asin((1 - p)/2)/T_s,
/// with the sample period T_s. With this delay, L is equal to the linear loop.
TEST(Bode, SpeedLawsHaveTheBandwidthOfTheirRule) {
  for (const study::SpeedLaw law : {study::SpeedLaw::state_feedback, study::SpeedLaw::disturbance_rejection,
                                    study::SpeedLaw::sliding_mode, study::SpeedLaw::pi}) {
    study::Scenario s = cascade(0.1);
    s.control.speed.settle_s = 20e-3;
    s.control.speed.law = law;
    if (law == study::SpeedLaw::pi) {
      s.control.speed.form = study::SpeedForm::positional;
      s.control.speed.setpoint_weight = 0.5;
    }
    s.pwm.chopping = control::Chopping::complementary;
    const auto b = analysis::study_bode(s);
    ASSERT_TRUE(b) << to_string(b.problems()[0]);
    ASSERT_TRUE(b->figures && b->measured.crossover_rad_s) << b->not_linear;
    EXPECT_NEAR(*b->measured.crossover_rad_s / *b->figures->crossover_rad_s, 1.0, 0.05);
    EXPECT_LT(off_by(*b, 0.3, 5), 0.08);
    if (law == study::SpeedLaw::pi) continue;
    const double p = std::exp(-4.6 * 30e-6 / 20e-3);
    EXPECT_NEAR(*b->measured.crossover_rad_s / (2 * std::asin((1 - p) / 2) / 30e-6), 1.0, 0.05);
  }
}

/// Field-oriented control of a sine machine gives the closed loop of its design rule, T(z) = z_1 (1 -
/// z_1)/(z^2 - z + z_1 (1 - z_1)) with the pole z_1. The pulses of the three legs are in the middle of the
/// period, so their effect is equal to the effect of a spread voltage.
TEST(Bode, FieldOrientedCurrentHasTheBandwidthOfItsRule) {
  study::Scenario s = maxon_scenario(control::Mode::current, 4.0);
  s.sheet.back_emf = design::BackEmfShape::sine;
  s.control.drive = study::FirmwareKind::field;
  s.pwm.period_s = 50e-6;
  s.pwm.alignment = study::Alignment::centre;
  s.pwm.delay_periods = 1;
  s.load.dynamometer_times_s = {0.0};
  s.load.dynamometer_rad_s = {100.0};
  const auto b = analysis::study_bode(s);
  ASSERT_TRUE(b) << to_string(b.problems()[0]);
  ASSERT_TRUE(b->figures && b->measured.bandwidth_rad_s);
  EXPECT_NEAR(*b->measured.bandwidth_rad_s / *b->figures->bandwidth_rad_s, 1.0, 0.01);
  EXPECT_NEAR(*b->measured.phase_rad, *b->figures->phase_rad, 0.02);
  EXPECT_LT(off_by(*b, 0.1, 10), 0.02);
}

/// The speed loop of a field-oriented drive sets the q current and has no commutation.
TEST(Bode, FieldOrientedSpeedLoopIsTheDesigned) {
  study::Scenario s = cascade(0.1);
  s.sheet.back_emf = design::BackEmfShape::sine;
  s.control.current = {};
  s.control.drive = study::FirmwareKind::field;
  s.pwm.period_s = 50e-6;
  s.pwm.alignment = study::Alignment::centre;
  s.pwm.delay_periods = 1;
  const auto b = analysis::study_bode(s);
  ASSERT_TRUE(b) << to_string(b.problems()[0]);
  ASSERT_TRUE(b->figures && b->measured.crossover_rad_s && b->measured.phase_rad) << b->not_linear;
  EXPECT_NEAR(*b->measured.crossover_rad_s / *b->figures->crossover_rad_s, 1.0, 0.02);
  EXPECT_NEAR(*b->measured.phase_rad, *b->figures->phase_rad, 0.02);
  EXPECT_LT(off_by(*b, 0.3, 5), 0.03);
  s.sheet.inductance_mH = std::nullopt;
  s.sheet.d_axis_inductance_mH = base::Quantity{0.2, "", ""};
  s.sheet.q_axis_inductance_mH = base::Quantity{0.4, "", ""};
  const auto salient = analysis::study_bode(s);
  ASSERT_TRUE(salient) << to_string(salient.problems()[0]);
  EXPECT_EQ(salient->not_linear, "a salient rotor's torque is not proportional to its current");
}

/// A hysteresis controller has no linear loop for comparison. The study reports only the measurement.
TEST(Bode, ABandHasNoLinearLoop) {
  study::Scenario s = cascade(0.1);
  s.control.current = {.type = study::CurrentLoopType::hysteresis, .band_A = 0.2};
  s.pwm.chopping = control::Chopping::complementary;
  const auto b = analysis::study_bode(s);
  ASSERT_TRUE(b) << to_string(b.problems()[0]);
  EXPECT_FALSE(b->designed);
  EXPECT_EQ(b->not_linear, "the current controller is a hysteresis, which is not linear");
  EXPECT_TRUE(b->measured.crossover_rad_s);
}

TEST(Bode, TheSameOrderGivesTheSameBits) {
  const auto one = analysis::study_bode(steady_current(true)),
             two = analysis::study_bode(steady_current(true));
  ASSERT_TRUE(one && two);
  ASSERT_EQ(one->points.size(), two->points.size());
  for (std::size_t k = 0; k < one->points.size(); ++k) {
    EXPECT_EQ(one->points[k].gain, two->points[k].gain);
    EXPECT_EQ(one->points[k].phase_rad, two->points[k].phase_rad);
  }
}

std::string problem_of(const study::Scenario& s, const analysis::BodeOrder& order = {}) {
  const auto b = analysis::study_bode(s, order);
  if (b) return "measured";
  EXPECT_FALSE(b.problems()[0].cure.empty());
  return b.problems()[0].where;
}

TEST(Bode, WhatCannotBeMeasuredIsToldWithAWayOut) {
  EXPECT_EQ(problem_of(maxon_scenario(control::Mode::duty, 0.5)), "control.mode");
  EXPECT_EQ(problem_of(maxon_scenario(control::Mode::current, 0.0)), "reference");
  EXPECT_EQ(problem_of(maxon_scenario(control::Mode::current, 0.0), {.amplitude = 0.1}), "measured");
  study::Scenario slewed = steady_current(true);
  slewed.control.slew = 1000.0;
  EXPECT_EQ(problem_of(slewed), "control.slew");
  study::Scenario moving = steady_current(true);
  moving.reference = {};
  moving.reference.shape = study::Shape::sine;
  moving.reference.offset = 5;
  moving.reference.amplitude = 1;
  moving.reference.frequency_Hz = 50;
  EXPECT_EQ(problem_of(moving), "reference");
  study::Scenario interrupted = steady_current(true);
  interrupted.duration_s = 1.0;
  EXPECT_EQ(problem_of(interrupted, {.keep_going = [](double) { return false; }}), "duration_s");
}

}  // namespace SIXSTEP_TEST_FILE
