// SPDX-License-Identifier: Apache-2.0
// The figures of a field-oriented drive are compared with the laws of its loops and of the voltage circle.
#include "sixstep/analysis/verify/field_study.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sixstep/base/angle.hpp"
#include "tests/support/figures.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using analysis::FieldStudy;
using control::Mode;
using design::LoopDesign;
using ::testing::HasSubstr;

constexpr double T = 50e-6, K_e = 0.01675, R = 0.515, L = 0.286e-3;

study::Scenario field_oriented(Mode mode, double reference) {
  study::Scenario s = maxon_scenario(mode, reference);
  s.sheet.back_emf = design::BackEmfShape::sine;
  s.sheet.torque_constant_mNm_A = std::nullopt;
  s.sheet.back_emf_mV_s = base::Quantity{16.75, "phase", ""};
  s.control.drive = study::FirmwareKind::field;
  s.control.speed.torque_limit_Nm = 0.2;
  s.pwm.alignment = study::Alignment::centre;
  s.pwm.period_s = T;
  s.pwm.delay_periods = 1;
  return s;
}

FieldStudy studied(const study::Scenario& s) {
  const auto f = analysis::study_field(s);
  EXPECT_TRUE(f) << to_string(f.problems()[0]);
  return f ? *f : FieldStudy{};
}

double value(const std::vector<design::DerivationStep>& steps, const std::string& symbol) {
  for (const auto& step : steps)
    if (step.symbol == symbol) return step.value;
  ADD_FAILURE() << symbol;
  return 0.0;
}

/// The loop with a delay is L = k/(z (z - 1)), with k = z_1 (1 - z_1) and the pole z_1. At the crossover w, 2
/// sin(w T/2) = k with the period T, and the phase is -90 degrees minus 3/2 w T.
TEST(FieldStudy, TheCurrentLoopHasTheMarginsOfItsRule) {
  study::Scenario s = field_oriented(Mode::current, 2.0);
  s.control.field.bandwidth_Hz = 800;
  const FieldStudy f = studied(s);
  ASSERT_EQ(f.design.loops.size(), 1u);
  const LoopDesign& loop = f.design.loops[0];
  const double z = std::exp(-2 * base::pi * 800 * T), k = z * (1 - z);
  const double w = 2 / T * std::asin(k / 2);
  ASSERT_TRUE(loop.figures.crossover_rad_s && loop.figures.phase_rad && loop.figures.gain);
  EXPECT_NEAR(*loop.figures.crossover_rad_s / w, 1.0, 1e-9);
  EXPECT_NEAR(*loop.figures.phase_rad, base::pi / 2 - 1.5 * w * T, 1e-9);
  // At k = 1 the closed loop is z^2 - z + 1, whose poles are on the unit circle.
  EXPECT_NEAR(*loop.figures.gain, 1 / k, 1e-9);
  EXPECT_NEAR(value(loop.steps, "z"), z, 1e-15);
  EXPECT_TRUE(f.warnings.empty());
}

TEST(FieldStudy, ASalientRotorHasAnAxisEach) {
  study::Scenario s = field_oriented(Mode::current, 2.0);
  s.sheet.inductance_mH = std::nullopt;
  s.sheet.d_axis_inductance_mH = base::Quantity{0.2, "", ""};
  s.sheet.q_axis_inductance_mH = base::Quantity{0.4, "", ""};
  const FieldStudy f = studied(s);
  ASSERT_EQ(f.design.loops.size(), 2u);
  const LoopDesign &d = f.design.loops[0], &q = f.design.loops[1];
  EXPECT_EQ(d.name, "current d");
  EXPECT_EQ(q.name, "current q");
  // The zero of each axis's controller cancels the pole of the winding in this axis, so both axes have the
  // same loop.
  EXPECT_NEAR(value(d.steps, "a0"), -std::exp(-R * T / 0.2e-3), 1e-12);
  EXPECT_NEAR(value(q.steps, "a0"), -std::exp(-R * T / 0.4e-3), 1e-12);
  EXPECT_NEAR(*d.figures.crossover_rad_s / *q.figures.crossover_rad_s, 1.0, 1e-9);
  EXPECT_NEAR(*d.figures.phase_rad, *q.figures.phase_rad, 1e-9);
  EXPECT_NEAR(value(f.axes, "k"), 0.2e-3 * 8 / (2 * K_e), 1e-12);
}

/// At the crossover w, the gain |L| of the loop is the full torque times the PI's gain, divided by J w. The
/// current loop and the sampling change |L| by less than w T, with the period T.
TEST(FieldStudy, TheSpeedLoopTurnsByTheTorqueOfIq) {
  study::Scenario s = field_oriented(Mode::speed, 300.0);
  s.control.speed.settle_s = 0.1;
  const FieldStudy f = studied(s);
  ASSERT_EQ(f.design.loops.size(), 2u);
  const LoopDesign& speed = f.design.loops[1];
  EXPECT_NEAR(value(f.axes, "K_q"), 1.5 * K_e, 1e-12);
  EXPECT_NEAR(f.design.torque_limit_Nm, 0.2, 1e-12);
  EXPECT_NEAR(f.design.current_at_full_torque_A, 0.2 / (1.5 * K_e), 1e-9);
  const double w = *speed.figures.crossover_rad_s, K_i = speed.gains.d1 + speed.gains.d0;
  const double pi = std::hypot(speed.gains.d1, K_i / (w * T));
  EXPECT_NEAR(0.2 / 135e-7 * pi / w, 1.0, w * T);
  EXPECT_TRUE(speed.figures.stable);
  EXPECT_TRUE(std::isfinite(speed.step.settling_s));
}

TEST(FieldStudy, TheCircleBoundsSpeedAndCurrent) {
  study::Scenario s = field_oriented(Mode::speed, 600.0);
  s.control.speed.settle_s = 0.1;
  s.control.current.limit_A = 6.0;  // below the current at full torque
  FieldStudy f = studied(s);
  const double circle = 24 / std::numbers::sqrt3;
  EXPECT_NEAR(value(f.limits, "U_s/sqrt 3"), circle, 1e-12);
  EXPECT_NEAR(value(f.limits, "w_0"), circle / K_e, 1e-9);
  const double w = value(f.limits, "w(i_q)");
  EXPECT_NEAR(std::hypot(R * 6 + w * K_e, w * 8 * L * 6), circle, 1e-9);
  const auto asks_for_weakening = [](const FieldStudy& of) {
    for (const design::Warning& warning : of.warnings)
      if (warning.cure.find("weakening_A") != std::string::npos) return true;
    return false;
  };
  EXPECT_FALSE(asks_for_weakening(f));
  s.reference.value = 1100.0;
  EXPECT_TRUE(asks_for_weakening(studied(s)));
  s.control.field.weakening_A = 5.0;
  f = studied(s);
  EXPECT_FALSE(asks_for_weakening(f));
  EXPECT_NEAR(value(f.limits, "w_1"), 0.95 * circle / (K_e - 8 * L * 5), 1e-9);
}

/// Low-side shunts: of the circle's radius the part 2 d - 1 for two shunts, (4/sqrt 3)(d - 1/2) for three. At the named
/// speed the largest current needs just this voltage.
TEST(FieldStudy, LowSideShuntsBoundTheModulation) {
  study::Scenario s = field_oriented(Mode::speed, 600.0);
  s.sensors.currents = rig::CurrentMeasurement::low_side;
  s.sensors.current_range_A = 20.0;
  s.sensors.shunt_settle_s = 2e-6;
  s.bridge.dead_time_s = 0.5e-6;
  s.control.current.limit_A = 6.0;  // below the current at full torque
  const double d = 1 - 2 * 2.5e-6 / T, circle = 24 / std::sqrt(3.0);
  const auto voltage = [](double w, double i) { return std::hypot(w * K_e + R * i, w * 8 * L * i); };
  for (const auto& [shunts, m] : {std::pair{study::ShuntLegs::ab, 2 * d - 1},
                                  std::pair{study::ShuntLegs::abc, 4 / std::sqrt(3.0) * (d - 0.5)}}) {
    s.sensors.shunts = shunts;
    const double up_to = value(studied(s).limits, "w(m)");
    for (const double asked : {0.98 * up_to, 1.02 * up_to}) {
      s.reference.value = asked;
      const FieldStudy f = studied(s);
      EXPECT_NEAR(value(f.limits, "d"), d, 1e-12);
      EXPECT_NEAR(value(f.limits, "m"), m, 1e-12);
      EXPECT_NEAR(voltage(value(f.limits, "w(m)"), 6.0), m * circle, 1e-9);
      const bool warned = std::any_of(f.warnings.begin(), f.warnings.end(), [](const design::Warning& w) {
        return w.what.find("fewer than two currents") != std::string::npos;
      });
      EXPECT_EQ(warned, asked > up_to) << asked;
    }
    study::Scenario by_current = s;
    by_current.control.mode = Mode::current;
    by_current.control.speed = {};
    by_current.control.speed.torque_limit_Nm.reset();
    for (const double ampere : {0.0, 2.0, -2.0}) {
      by_current.reference.value = ampere;
      EXPECT_NEAR(voltage(value(studied(by_current).limits, "w(m)"), std::fabs(ampere)), m * circle, 1e-9);
    }
  }
}

/// The settling time of a step of i_q at a locked rotor, predicted by the linear loop, is equal to the
/// simulated one within one sample.
TEST(FieldStudy, TheStepIsTheRuns) {
  study::Scenario s = field_oriented(Mode::current, 2.0);
  s.load.locked = true;
  s.duration_s = 3e-3;
  const FieldStudy f = studied(s);
  study::Measure settling = measure(study::MetricKind::settling_time, study::Signal::quadrature_current);
  settling.sampled = true;
  ask(s, settling);
  EXPECT_NEAR(figures_of(s)[0], f.design.loops[0].step.settling_s, T);
}

/// As for six-step loops, a grave warning reports a phase margin below 20 degrees or an unstable loop.
TEST(FieldStudy, LittlePhaseIsGrave) {
  int usable = 0, little = 0;
  for (double settle_s = 0.5e-3; settle_s < 20e-3; settle_s *= 1.1) {
    study::Scenario s = field_oriented(Mode::speed, 300.0);
    s.control.speed.settle_s = settle_s;
    const auto f = analysis::study_field(s);
    if (!f) continue;
    const LoopDesign& loop = f->design.loops.back();
    ASSERT_EQ(loop.name, "speed");
    const bool stable = loop.figures.stable && loop.built.stable;
    const double phase_deg = stable ? loop.built.phase_rad.value_or(base::pi) * 180 / base::pi : 0;
    bool grave = false;
    for (const auto& w : f->warnings)
      grave = grave || (w.grave && w.what.find("speed loop") != std::string::npos);
    EXPECT_EQ(grave, phase_deg < 20) << settle_s << ": " << phase_deg;
    little += stable && phase_deg < 20;
    usable += !grave;
  }
  EXPECT_GT(usable, 5);
  EXPECT_GT(little, 0);
}

TEST(FieldStudy, WhatIsWrongIsTold) {
  study::Scenario fast = field_oriented(Mode::speed, 300.0);
  fast.control.speed.settle_s = 1e-3;
  const FieldStudy f = studied(fast);
  ASSERT_FALSE(f.warnings.empty());
  EXPECT_THAT(f.warnings[0].cure, HasSubstr("control.speed.settle_s"));
  const auto six_step = analysis::study_field(maxon_scenario(Mode::current, 2.0));
  ASSERT_FALSE(six_step);
  EXPECT_EQ(six_step.problems()[0].where, "control.drive");
  const auto off = analysis::study_field(field_oriented(Mode::off, 0.0));
  ASSERT_FALSE(off);
  EXPECT_EQ(off.problems()[0].where, "control.mode");
}

}  // namespace SIXSTEP_TEST_FILE
