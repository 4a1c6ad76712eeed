// SPDX-License-Identifier: Apache-2.0
// A linear motor is compared with the rotary motor of pi/tau pole pairs (pole pitch tau), with kg for kg m2
// and N for N m. The results have the same bits. The texts use other terms.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/study/check/check.hpp"
#include "sixstep/study/measure/columns.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using study::Scenario;

/// The pole pitch is pi/8 m, so pi/tau is exactly 8.
Scenario on_a_line(Scenario s) {
  s.sheet.kind = design::MotorKind::linear;
  s.sheet.pole_pairs.reset();
  s.sheet.pole_pitch_mm = base::Quantity{1e3 * (base::pi / 8), "", ""};
  return s;
}

std::vector<Scenario> drives() {
  std::vector<Scenario> all{maxon_scenario(control::Mode::duty, 0.5), current_square(), cascade()};
  Scenario cogs = all[0];
  cogs.sheet.cogging_orders = {48};
  cogs.sheet.cogging_mNm = {5};
  all.push_back(cogs);
  Scenario swings = all[0];
  swings.load.stiffness_Nm_rad = 2;
  swings.load.inertia_kg_m2 = 1e-5;
  all.push_back(swings);
  return all;
}

TEST(LinearMotor, RunsTheBitsOfTheTurningOne) {
  for (const Scenario& turning : drives()) {
    Scenario linear = on_a_line(turning);
    for (double& order : linear.sheet.cogging_orders) order /= 8;  // order per two pole pitches
    const auto a = study::run(turning), b = study::run(linear);
    ASSERT_TRUE(a && b) << base::to_string((a ? b : a).problems()[0]);
    EXPECT_EQ(b->motor.machine.pole_pairs, 8.0);
    EXPECT_EQ(a->digest, b->digest);
    EXPECT_EQ(a->energy->air_gap, b->energy->air_gap);
  }
}

TEST(LinearMotor, NeedNotHaveAWholeNumberOfPolePairsInAMetre) {
  // The rotary motor of radius r has v = r w, F = T/r and m = J/r^2 (speed v, force F, mass m). With powers
  // of two, this conversion adds no rounding.
  const double r = 0x1p-6;
  Scenario turning = maxon_scenario(control::Mode::duty, 0.5), linear = on_a_line(turning);
  linear.sheet.pole_pitch_mm->value = 1e3 * (base::pi / 8) * r;
  linear.sheet.torque_constant_mNm_A->value /= r;
  linear.sheet.inertia_gcm2->value /= r * r;
  linear.sheet.viscous_friction_Nm_s->value /= r * r;
  const auto at_end = [](Scenario& s) {
    for (const study::Signal signal : {study::Signal::speed, study::Signal::phase_a, study::Signal::torque})
      ask(s, measure(study::MetricKind::final_value, signal));
    const auto out = study::run(s);
    EXPECT_TRUE(out) << base::to_string(out.problems()[0]);
    return out->comparisons;
  };
  const auto a = at_end(turning), b = at_end(linear);
  EXPECT_NEAR(b[0].measured, a[0].measured * r, 1e-13 * a[0].measured * r);
  EXPECT_NEAR(b[1].measured, a[1].measured, 1e-12);
  EXPECT_NEAR(b[2].measured, a[2].measured / r, 1e-12 / r);
}

TEST(LinearMotor, IsToldOfInMetresAndNewtons) {
  Scenario s = on_a_line(maxon_scenario(control::Mode::duty, 0.5)),
           turning = maxon_scenario(control::Mode::duty, 0.5);
  for (Scenario* each : {&s, &turning})
    for (const study::Signal signal : {study::Signal::position, study::Signal::angle, study::Signal::torque})
      ask(*each, measure(study::MetricKind::final_value, signal));
  const auto told = study::run(s)->comparisons, known = study::run(turning)->comparisons;
  EXPECT_EQ(told[0].unit, "mm");
  EXPECT_NEAR(told[0].measured, known[0].measured * 1e3 * base::pi / 180, 1e-9);
  EXPECT_EQ(told[1].unit, "m");
  EXPECT_EQ(told[1].measured, known[1].measured);
  EXPECT_EQ(told[2].unit, "N");
  EXPECT_EQ(told[2].figure, "final force");
}

TEST(LinearMotor, RecordsColumnsUnderItsOwnNames) {
  Scenario s = on_a_line(maxon_scenario(control::Mode::duty, 0.5)),
           turning = maxon_scenario(control::Mode::duty, 0.5);
  s.record.columns = {"speed_m_s", "position_mm", "force_N"};
  turning.record.columns = {"speed_rad_s", "angle_rad", "torque_Nm"};
  const auto last = [](const Scenario& from) {
    std::vector<double> row;
    EXPECT_TRUE(study::run(from, {.on_record = [&](study::Row r) { row.assign(r.begin(), r.end()); }}));
    return row;
  };
  const std::vector<double> a = last(s), b = last(turning);
  ASSERT_EQ(a.size(), 4u);
  EXPECT_EQ(a[1], b[1]);
  EXPECT_EQ(a[2], b[2] * 1e3);
  EXPECT_EQ(a[3], b[3]);
  EXPECT_EQ(study::record_columns(s)->at(2).unit, "mm");
  s.record.columns = {"speed_rad_s"};
  EXPECT_FALSE(study::check(s).empty());
}

TEST(LinearMotor, WhatTurnsHasNoPlaceThere) {
  const auto first = [](const std::function<void(Scenario&)>& make) {
    Scenario s = on_a_line(maxon_scenario(control::Mode::duty, 0.5));
    make(s);
    const base::Problems problems = study::check(s);
    return problems.empty() ? std::string() : problems[0].where;
  };
  EXPECT_EQ(first([](Scenario&) {}), "");
  EXPECT_EQ(first([](Scenario& s) { s.sheet.pole_pairs = 8; }), "pole_pairs");
  EXPECT_EQ(first([](Scenario& s) { s.sheet.pole_pitch_mm.reset(); }), "pole_pitch_mm");
  EXPECT_EQ(first([](Scenario& s) { s.load.gravity_Nm = 0.1; }), "load.gravity_Nm");
  EXPECT_EQ(first([](Scenario& s) { s.load.gear = 2; }), "load.gear");
  EXPECT_EQ(first([](Scenario& s) { s.sheet.kind = design::MotorKind::rotary; }), "pole_pitch_mm");
}

}  // namespace SIXSTEP_TEST_FILE
