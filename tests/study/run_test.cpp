// SPDX-License-Identifier: Apache-2.0
// Tests complete runs of scenarios that are built in C++.
#include "sixstep/study/run/run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using namespace sixstep::study;
using control::Mode;

std::vector<std::pair<const char*, Scenario>> many() {
  std::vector<std::pair<const char*, Scenario>> all;
  all.emplace_back("duty", maxon_scenario(Mode::duty, 0.5));
  Scenario s = maxon_scenario(Mode::duty, 0.5);
  s.pwm.chopping = control::Chopping::complementary;
  s.bridge = {
      .on_resistance_ohm = 0.01, .diode_drop_V = 0.7, .diode_resistance_ohm = 0.01, .dead_time_s = 1e-6};
  all.emplace_back("devices", s);
  s.supply = {.voltage_V = 24.0, .resistance_ohm = 0.1, .capacitance_F = 1e-3, .sinks = false};
  s.initial.speed_rad_s = 500.0;
  all.emplace_back("regeneration", s);
  all.emplace_back("current", current_square());
  s = current_square();
  s.control.current = {.type = CurrentLoopType::hysteresis};
  all.emplace_back("hysteresis", s);
  s = maxon_scenario(Mode::speed, 200.0);
  s.load.coulomb_Nm = 0.005;
  s.load.times_s = {10e-3};
  s.load.torques_Nm = {0.1};
  all.emplace_back("speed", s);
  s = maxon_scenario(Mode::position, 90.0);
  s.sheet.back_emf = design::BackEmfShape::sine;
  all.emplace_back("position, sine", s);
  return all;
}

TEST(Run, LawsHoldInEveryMode) {
  for (const auto& [name, scenario] : many()) {
    SCOPED_TRACE(name);
    const auto out = run(scenario);
    ASSERT_TRUE(out) << to_string(out.problems()[0]);
    EXPECT_FALSE(out->fault);
    EXPECT_EQ(out->simulated_s, scenario.duration_s);
    EXPECT_LE(std::fabs(out->energy->electrical_residual), 1e-11);
    EXPECT_LE(std::fabs(out->energy->mechanical_residual), 1e-11);
    EXPECT_LE(out->laws->current_sum_A, 8 * 0x1p-52 * 50);
    EXPECT_LE(out->laws->reverse_diode_A, 128 * 0x1p-52 * 100);
    EXPECT_EQ(out->laws->floating_current_A, 0.0);
  }
}

double asked(const Outcome& out, std::size_t n = 0) { return out.comparisons.at(n).measured; }

Scenario with_finals(Scenario s) {
  ask(s, measure(MetricKind::final_value, Signal::speed));
  ask(s, measure(MetricKind::final_value, Signal::phase_a));
  ask(s, measure(MetricKind::mean, Signal::current));
  return s;
}

TEST(Run, RecordersDoNotChangeABit) {
  for (auto& [name, scenario] : many()) {
    SCOPED_TRACE(name);
    const Scenario s = with_finals(scenario);
    const auto alone = run(s);
    int rows = 0;
    const auto watched = run(s, {.on_record = [&](Row) { ++rows; }, .on_event = [&](Row) { ++rows; }});
    ASSERT_TRUE(alone && watched);
    EXPECT_GT(rows, 100);
    EXPECT_EQ(alone->segments, watched->segments);
    for (std::size_t n = 0; n < 3; ++n) EXPECT_EQ(asked(*alone, n), asked(*watched, n));
    EXPECT_EQ(alone->energy->supplied, watched->energy->supplied);
  }
}

TEST(Run, KeepGoingEndsItEarly) {
  Scenario s = maxon_scenario(Mode::duty, 0.5);
  s.duration_s = 1.0;
  double told = -1;
  const auto out = run(s, {.keep_going = [&](double t_s) { return (told = t_s) < 0.1; }});
  ASSERT_TRUE(out);
  EXPECT_GE(out->simulated_s, 0.1);
  EXPECT_LT(out->simulated_s, 0.2);
  EXPECT_EQ(out->simulated_s, told);
}

TEST(Run, GridHasARowPerPointAndOneAtTheEnd) {
  Scenario s = maxon_scenario(Mode::duty, 0.5);
  s.record.grid_s = 1e-4;
  s.record.columns = {"speed_rad_s", "i_a_A"};
  std::vector<double> t, w;
  ASSERT_TRUE(run(with_finals(s), {.on_record = [&](Row row) {
                    ASSERT_EQ(row.size(), 3u);
                    t.push_back(row[0]);
                    w.push_back(row[1]);
                  }}));
  ASSERT_EQ(t.size(), 201u);
  for (std::size_t n = 0; n < t.size(); ++n) EXPECT_EQ(t[n], static_cast<double>(n) * 100'000'000 / 1e12);
  const auto out = run(with_finals(s));
  EXPECT_EQ(w.back(), asked(*out)) << "the last row is the end of the run";
}

TEST(Run, GridRowsAreRightLimits) {
  // The duty steps at a grid point. The row at this point shows the gates after the step.
  Scenario s = maxon_scenario(Mode::duty, 0.0);
  s.reference.shape = Shape::steps;
  s.reference.times_s = {0.0, 3e-3};
  s.reference.values = {0.0, 0.5};
  s.record.grid_s = 1e-3;
  s.record.columns = {"duty", "gate_T1"};
  std::vector<double> duty, gate;
  ASSERT_TRUE(run(s, {.on_record = [&](Row row) {
                    duty.push_back(row[1]);
                    gate.push_back(row[2]);
                  }}));
  EXPECT_EQ(duty[2], 0.0);
  EXPECT_EQ(duty[3], 0.5);
  EXPECT_EQ(gate[3], 1.0);
}

TEST(Run, AGridRowOnATickIsBehindItWhereverTheLastEdgeWas) {
  // Edges are between two picoseconds, so the time from an edge to the tick is rounded. The row at the tick
  // must show the tick's command: each period begins with the upper switch on.
  Scenario s = current_square();
  s.record.grid_s = s.pwm.period_s;
  s.record.columns = {"duty", "gate_T1", "gate_T3", "gate_T5"};
  int on = 0, rows = 0;
  ASSERT_TRUE(run(s, {.on_record = [&](Row row) {
                    if (row[1] == 0.0 || row[0] >= s.duration_s) return;
                    ++rows;
                    on += row[2] + row[3] + row[4] == 1.0;
                  }}));
  EXPECT_GT(rows, 600);
  EXPECT_EQ(on, rows);
}

TEST(Run, SinglePrecisionControlFollowsDouble) {
  Scenario s = with_finals(current_square());
  const auto wide = run(s);
  s.control.arithmetic = Arithmetic::float32;
  const auto narrow = run(s);
  ASSERT_TRUE(wide && narrow);
  // In each of 667 samples, a few values of 24 V are rounded in single precision. An error in the loop decays
  // faster than this sum grows.
  const double bound = 667 * 4 * 0x1p-23 * 24.0 / 1.03;
  EXPECT_NEAR(asked(*wide, 1), asked(*narrow, 1), bound);
  EXPECT_NEAR(asked(*wide, 2), asked(*narrow, 2), bound);
  EXPECT_NE(asked(*wide, 1), asked(*narrow, 1)) << "it is another arithmetic";
}

TEST(Run, StallFollowsTheClosedForm) {
  Scenario s = maxon_scenario(Mode::duty, 1.0);
  s.load.locked = true;
  s.initial.angle_rad = 0.02;
  s.duration_s = 5e-3;
  Measure reach = measure(MetricKind::reach_time, Signal::current);
  reach.level = 24.0 / 1.03;
  reach.start = 0.0;
  reach.fraction = 0.5;
  ask(s, reach);
  ask(s, measure(MetricKind::mean, Signal::current));
  ask(s, measure(MetricKind::maximum, Signal::torque));
  const auto out = run(s);
  ASSERT_TRUE(out);
  const double tau = 0.572e-3 / 1.03, full = 24.0 / 1.03, T = 5e-3;
  EXPECT_NEAR(asked(*out, 0), tau * std::log(2.0), 64 * 0x1p-52 * tau);
  EXPECT_NEAR(asked(*out, 1), full * (1 + tau / T * std::expm1(-T / tau)), 64 * 0x1p-52 * full);
  EXPECT_NEAR(asked(*out, 2), -0.0335 * full * std::expm1(-T / tau), 64 * 0x1p-52);
}

TEST(Run, NoLoadSteadyStateIsTheReferences) {
  // The expected values are the means of the reference trajectory R2 over [0.2, 0.3] s.
  Scenario s = maxon_scenario(Mode::duty, 1.0);
  s.duration_s = 0.3;
  for (const Signal signal : {Signal::speed, Signal::current_magnitude}) {
    Measure m = measure(MetricKind::mean, signal);
    m.from_s = 0.2;
    ask(s, m);
  }
  const auto out = run(s);
  ASSERT_TRUE(out);
  EXPECT_NEAR(asked(*out, 0), 702.280531109707, 1e-12 * 702.3);
  EXPECT_NEAR(asked(*out, 1), 0.156899380737454, 1e-10 * 23.3);
}

TEST(Run, RequirementsBecomeVerdicts) {
  Scenario s = maxon_scenario(Mode::duty, 0.5);
  const Measure w = measure(MetricKind::final_value, Signal::speed);
  s.require = {{w, 1.0, std::nullopt}, {w, std::nullopt, 1.0}};
  const auto out = run(s);
  ASSERT_TRUE(out);
  ASSERT_EQ(out->verdicts.size(), 2u);
  EXPECT_TRUE(out->verdicts[0].ok);
  EXPECT_FALSE(out->verdicts[1].ok);
  EXPECT_FALSE(out->passed());
  EXPECT_EQ(out->verdicts[0].measured, out->verdicts[1].measured);
  EXPECT_EQ(out->verdicts[0].unit, "rad/s");
}

TEST(Run, HysteresisKeepsItsBand) {
  Scenario s = current_square();
  s.control.current = {.type = CurrentLoopType::hysteresis, .band_A = 0.2};
  ask(s, measure(MetricKind::band_excess, Signal::current));
  ask(s, measure(MetricKind::band_deficit, Signal::current));
  const auto out = run(s);
  ASSERT_TRUE(out);
  EXPECT_NEAR(asked(*out, 0), 0.0, 1e-11);
  EXPECT_NEAR(asked(*out, 1), 0.0, 1e-11);
}

TEST(Run, TurnOnsAreThoseOfThePwmHoweverManySwitchesTakePart) {
  using control::Chopping;
  for (const Chopping chopping : {Chopping::soft, Chopping::hard, Chopping::complementary}) {
    Scenario s = current_square();
    s.control.mode = control::Mode::duty;
    s.reference = {.value = 0.6};
    s.pwm.period_s = 50e-6;
    s.pwm.chopping = chopping;
    s.bridge.dead_time_s = 1e-6;
    s.duration_s = 0.1;
    const auto out = run(s);
    ASSERT_TRUE(out);
    EXPECT_NEAR(static_cast<double>(out->turn_ons), 0.1 * 20e3, 1.0) << static_cast<int>(chopping);
  }
}

TEST(Run, APulseOrGapBelowTheMinimumIsNotSwitched) {
  for (const auto& [duty, minimum_s, turn_ons] : {std::tuple{0.04, 0.0, 100},
                                                  {0.04, 1.1e-6, 100},
                                                  {0.04, 1.3e-6, 0},
                                                  {0.96, 1.1e-6, 100},
                                                  {0.96, 1.3e-6, 1}}) {
    Scenario s = maxon_scenario(control::Mode::duty, duty);  // the pulse is 1.2 us of 30 us
    s.pwm.minimum_pulse_s = minimum_s;
    s.duration_s = 2.99e-3;  // number of started periods: 100
    const auto out = run(s);
    ASSERT_TRUE(out);
    EXPECT_EQ(out->turn_ons, turn_ons) << duty << " " << minimum_s;
  }
}

/// The switching frequency of a pair and of three legs is equal to the PWM frequency. The period that begins
/// at the end of the run does not count.
TEST(Run, APwmReadsItsOwnFrequency) {
  Scenario pair = maxon_scenario(control::Mode::duty, 0.5);
  pair.duration_s = 3e-3;  // 100 periods
  Scenario legs = maxon_scenario(control::Mode::current, 1.0);
  legs.control.drive = FirmwareKind::field;
  legs.sheet.back_emf = design::BackEmfShape::sine;
  legs.pwm.alignment = Alignment::centre;
  legs.load.locked = true;
  legs.duration_s = 3e-3;
  for (Scenario* s : {&pair, &legs}) {
    ask(*s, measure(MetricKind::switching_frequency, Signal::current));
    const auto out = run(*s);
    ASSERT_TRUE(out) << to_string(out.problems()[0]);
    const double hertz = static_cast<double>(out->turn_ons) / out->chopped_switches / out->simulated_s;
    EXPECT_NEAR(hertz, 1 / 30e-6, s == &pair ? 1e-6 : 1 / 3e-3) << "of legs that begin within the on-time";
    EXPECT_NEAR(asked(*out, 0), 1 / 30e-6, s == &pair ? 1e-6 : 1 / 3e-3);
  }
}

TEST(Run, SwitchingFrequencyIsTurnOnsOverTheWindow) {
  Scenario s = current_square();
  s.control.current = {.type = CurrentLoopType::hysteresis, .band_A = 0.2};
  Measure m = measure(MetricKind::switching_frequency, Signal::current);
  ask(s, m);
  for (int n = 0; n < 4; ++n) {
    m.from_s = n * 5e-3;
    m.to_s = (n + 1) * 5e-3;
    ask(s, m);
  }
  const auto out = run(s);
  ASSERT_TRUE(out);
  EXPECT_NEAR(asked(*out, 0) * 20e-3, 332.0, 1.0) << "R7s: 332 times off";
  EXPECT_NEAR(asked(*out, 1) + asked(*out, 2) + asked(*out, 3) + asked(*out, 4), 4 * asked(*out, 0), 1e-6);
}

}  // namespace SIXSTEP_TEST_FILE
