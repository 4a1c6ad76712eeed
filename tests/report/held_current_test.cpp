// SPDX-License-Identifier: Apache-2.0
// Tests the step and the current that a report shows for simulated runs.
#include "report/held_current.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "files/scenario_on_disk.hpp"
#include "report/figures.hpp"
#include "report/highlights.hpp"
#include "report/kept_rows.hpp"
#include "report/summary.hpp"
#include "report/windows.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace report;
using namespace sixstep;
using sixstep::testing::ask;
using sixstep::testing::cascade;
using sixstep::testing::maxon_scenario;
using sixstep::testing::measure;
using ::testing::HasSubstr;
using ::testing::Not;

struct Ran {
  study::Outcome outcome;
  study::Trace trace;
};
Ran ran(const study::Scenario& s) {
  KeptRows kept(s);
  const auto outcome = study::run(s, {.on_event = [&](study::Row row) { kept.add(row); }});
  if (!outcome) {
    ADD_FAILURE() << outcome.problems().front().limit;
    return {};
  }
  return {*outcome, kept.trace()};
}

/// The drive aligns the rotor and accelerates it by the ramp. The hand-over is at about 0.3 s.
study::Scenario sensorless(double duration_s) {
  study::Scenario s = maxon_scenario(control::Mode::speed, 100.0);
  s.duration_s = duration_s;
  s.sheet.no_load_speed_rpm = base::Quantity{6710, "", ""};
  s.sheet.nominal_current_A = base::Quantity{2.33, "terminal", ""};
  s.control.drive = study::FirmwareKind::sensorless;
  s.control.current.settle_s = 1e-3;
  s.control.speed.settle_s = 0.1;
  s.pwm.alignment = study::Alignment::centre;
  s.pwm.sample = study::SampleAt::middle;
  s.load.coulomb_Nm = 0.01;
  s.initial.angle_rad = 0.3;
  return s;
}

TEST(HeldCurrent, a_sensorless_drives_handover_is_no_step_and_a_later_change_is) {
  study::Scenario s = sensorless(0.36);
  const Ran run = ran(s);
  EXPECT_NEAR(find_column(run.trace, "speed_ref_rad_s")->back(), 100.0, 1e-9) << "it was handed over";
  const auto whole_run = largest_step(run.trace, s);
  ASSERT_TRUE(whole_run);
  EXPECT_EQ(whole_run->of, "start");
  s.reference = {.shape = study::Shape::steps, .times_s = {0, 0.34}, .values = {100, 130}};
  const auto step = largest_step(ran(s).trace, s);
  ASSERT_TRUE(step);
  EXPECT_EQ(step->of, "speed");
  EXPECT_NEAR(step->from, 100.0, 1e-9);
  EXPECT_NEAR(step->to, 130.0, 1e-9);
  EXPECT_NEAR(step->at_s, 0.34, s.pwm.period_s);
}

TEST(HeldCurrent, of_a_sensorless_drive_is_the_largest_of_the_phases) {
  const study::Scenario s = sensorless(0.36);
  const Ran run = ran(s);
  const HeldCurrent held = held_by(s);
  EXPECT_STREQ(held.title, "Largest phase current");
  const auto largest = held_values(run.trace, held);
  ASSERT_TRUE(largest);
  const auto &a = *find_column(run.trace, "i_a_A"), &b = *find_column(run.trace, "i_b_A"),
             &c = *find_column(run.trace, "i_c_A"), &t = *find_column(run.trace, "t_s"),
             &m = *find_column(run.trace, "i_m_A");
  std::size_t apart = 0;
  for (std::size_t n = 0; n < largest->size(); ++n) {
    // The three currents sum to zero, so the largest magnitude is half the sum of the magnitudes.
    ASSERT_NEAR((*largest)[n], (std::abs(a[n]) + std::abs(b[n]) + std::abs(c[n])) / 2, 1e-12) << t[n];
    ASSERT_GE((*largest)[n] + 1e-12, std::abs(m[n])) << t[n];
    apart += (*largest)[n] > 1.5 * std::abs(m[n]) + 0.1;
  }
  EXPECT_GT(apart, largest->size() / 10) << "the pair that pulls is not that of the rotor";
  const auto current = step_current(run.trace, *largest_step(run.trace, s));
  ASSERT_TRUE(current);
  EXPECT_NEAR(*current->asked_A, 1.5 * 2.33, 1e-9) << "1.5 times the nominal current pull it";
}

/// The probes are connected to other pins. The board therefore drives a pair that does not belong to the
/// rotor's sector.
TEST(HeldCurrent, of_a_drive_whose_probes_are_elsewhere_too) {
  study::Scenario s = maxon_scenario(control::Mode::duty, 1.0);
  s.duration_s = 300e-6;
  s.load.locked = true;
  s.sensors.hall_lines = rig::WireOrder::bca;
  ask(s, measure(study::MetricKind::maximum, study::Signal::phase_a));
  ask(s, measure(study::MetricKind::minimum, study::Signal::phase_a));
  const Ran run = ran(s);
  const double most =
      std::max(std::abs(run.outcome.comparisons[0].measured), std::abs(run.outcome.comparisons[1].measured));
  EXPECT_GT(most, 1.0);
  const auto current = step_current(run.trace, *largest_step(run.trace, s));
  ASSERT_TRUE(current);
  EXPECT_NEAR(current->peak_A, most, 1e-12);
  EXPECT_THAT(glance_section(s, run.outcome, run.trace), Not(HasSubstr("asked for then")));
}

TEST(HeldCurrent, what_was_asked_for_has_the_sign_and_the_time_of_the_peak) {
  study::Scenario s = cascade();
  s.reference.value = -100.0;
  const Ran run = ran(s);
  const auto step = largest_step(run.trace, s);
  const auto current = step_current(run.trace, *step);
  ASSERT_TRUE(current && current->asked_A);
  EXPECT_LT(current->peak_A, 0.0);
  const auto &t = *find_column(run.trace, "t_s"), &m = *find_column(run.trace, "i_m_A"),
             &reference = *find_column(run.trace, "i_ref_A");
  bool seen = false;
  for (std::size_t n = 0; n < t.size(); ++n)
    if (t[n] - step->at_s == current->peak_after_s && m[n] == current->peak_A)
      seen = seen || reference[n] == *current->asked_A;
  EXPECT_TRUE(seen);
  EXPECT_THAT(glance_section(s, run.outcome, run.trace),
              HasSubstr("(reference then: " + computed(*current->asked_A, "A") + ")"));
}

/// The mean that the report shows after the step is equal to the metric `mean` from the same time on.
TEST(HeldCurrent, the_mean_behind_a_step_is_from_the_moment_told_on) {
  study::Scenario s = maxon_scenario(control::Mode::current, 2.0);
  s.control.current.settle_s = 1e-3;
  s.load.locked = true;
  Ran run = ran(s);
  const auto step = largest_step(run.trace, s);
  ASSERT_TRUE(step && step->done);
  study::Measure mean = measure(study::MetricKind::mean, study::Signal::current);
  mean.from_s = step->window.to;
  ask(s, mean);
  run = ran(s);
  const auto current = step_current(run.trace, *step);
  EXPECT_NEAR(*current->then_mean_A, run.outcome.comparisons[0].measured, 1e-4);
  EXPECT_THAT(
      glance_section(s, run.outcome, run.trace),
      HasSubstr("In the first " + computed(step->window.to - step->at_s, "s") + " after the step: peak <b>"));
  EXPECT_THAT(glance_section(s, run.outcome, run.trace),
              HasSubstr("From then until the end: " + computed(*current->then_mean_A, "A") + " on average"));
}

/// A current of 1e-25 A is the rounding error of a sum, so the report prints 0.
TEST(HeldCurrent, what_only_rounding_left_is_none) {
  study::Scenario s = maxon_scenario(control::Mode::current, 2.0);
  s.control.current.settle_s = 1e-3;
  s.load.locked = true;
  Ran run = ran(s);
  const auto step = largest_step(run.trace, s);
  ASSERT_TRUE(step);
  for (std::size_t n = 0; n < run.trace.columns.size(); ++n)
    if (run.trace.columns[n].name == "i_m_A")
      for (double& ampere : run.trace.values[n]) ampere *= 1e-25;
  const auto current = step_current(run.trace, *step);
  ASSERT_TRUE(current && current->then_mean_A);
  for (const double ampere : {current->peak_A, current->rms_A, *current->then_mean_A, current->then_high_A})
    EXPECT_EQ(ampere, 0.0);
}

/// At the instant of the step, the current still has its old level. The magnitude of the old level may exceed
/// the new peak.
TEST(HeldCurrent, the_peak_of_a_reversal_is_one_of_the_new_sign) {
  study::Scenario s = maxon_scenario(control::Mode::current, 5.0);
  s.control.current.settle_s = 1e-3;
  s.load.locked = true;
  s.duration_s = 0.01;
  s.reference = {};
  s.reference.shape = study::Shape::steps;
  s.reference.times_s = {0, 0.005};
  s.reference.values = {5, -5};
  const auto step = largest_step(ran(s).trace, s);
  ASSERT_TRUE(step && step->done);
  EXPECT_EQ(step->to, -5.0);
  study::Measure lowest = measure(study::MetricKind::minimum, study::Signal::current);
  lowest.from_s = step->at_s;
  lowest.to_s = step->window.to;
  ask(s, lowest);
  const Ran run = ran(s);
  const auto current = step_current(run.trace, *step);
  ASSERT_TRUE(current);
  EXPECT_NEAR(current->peak_A, run.outcome.comparisons[0].measured, 1e-3);
  EXPECT_GT(current->peak_after_s, 0.0);
  EXPECT_LE(current->then_low_A, *current->then_mean_A);
  EXPECT_GE(current->then_high_A, *current->then_mean_A);
}

/// The magnitudes of the phase currents are 5.4 A at the old level, 0 A at the zero crossing, and 5.1 A at
/// the new level.
TEST(HeldCurrent, the_peak_of_magnitudes_lies_behind_the_crossing) {
  study::Trace trace;
  for (const char* name : {"t_s", "i_a_A", "i_b_A", "i_c_A"}) trace.columns.push_back({name, "", "", ""});
  trace.values = {{0, 1, 2, 3}, {5.4, 0, -5.1, -5}, {-5.4, 0, 5.1, 5}, {0, 0, 0, 0}};
  Step step{.of = "current", .unit = "A", .from = 5, .to = -5, .next_s = 3, .window = {0, 3}};
  step.held = {"Largest phase current", "", "i_ref_A", "", "", true};
  EXPECT_EQ(step_current(trace, step)->peak_A, 5.1);
}

/// The index is at 360 degrees of the shaft, and the drive counts from this angle. The drive's 90 degrees are
/// therefore 450 degrees of the shaft.
TEST(HeldCurrent, an_encoders_step_ends_where_the_shaft_does) {
  const auto s = files::read_scenario(SIXSTEP_SOURCE_DIR "/data/scenarios/gallery/encoder.toml");
  ASSERT_TRUE(s);
  const Ran run = ran(*s);
  const auto step = largest_step(run.trace, *s);
  ASSERT_TRUE(step);
  const double end = find_column(run.trace, "angle_rad")->back() * 180 / base::pi;
  EXPECT_NEAR(step->to, end, 0.18) << "two counts, as the scenario requires";
  EXPECT_NEAR(step->from, 6.1 * 180 / base::pi, 1e-9);
  EXPECT_THAT(glance_section(*s, run.outcome, run.trace), HasSubstr("to 450°, 90° from the encoder's index"));
}

/// The shaft already turns when the drive's speed loop starts. The step therefore starts from the shaft's
/// speed.
TEST(HeldCurrent, of_an_observers_drive_the_step_begins_at_the_speed_that_is_taken_over) {
  study::Scenario s;
  s.control.mode = control::Mode::speed;
  s.control.drive = study::FirmwareKind::field;
  s.control.field.angle = study::FieldAngle::observer;
  s.pwm.period_s = 0.1;
  study::Trace trace;
  for (const char* name : {"t_s", "speed_ref_rad_s", "speed_rad_s"})
    trace.columns.push_back({name, "", "", ""});
  trace.values = {{0, 1, 1, 2, 3}, {0, 0, 200, 200, 200}, {0, 70, 70, 150, 200}};
  const auto step = largest_step(trace, s);
  ASSERT_TRUE(step);
  EXPECT_EQ(step->from, 70.0);
  EXPECT_EQ(step->to, 200.0);
}

}  // namespace SIXSTEP_TEST_FILE
