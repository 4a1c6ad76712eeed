// SPDX-License-Identifier: Apache-2.0
// Tests the conclusions that a report draws from the rows of one run or of several runs.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "report/conduction.hpp"
#include "report/cost_card.hpp"
#include "report/figures.hpp"
#include "report/groups.hpp"
#include "report/highlights.hpp"
#include "report/html.hpp"
#include "report/packed_rows.hpp"
#include "report/parameters.hpp"
#include "report/spectra.hpp"
#include "report/spectrum.hpp"
#include "report/summary.hpp"
#include "report/verdicts.hpp"
#include "sixstep/design/sheet/sheet_description.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "tests/report/synthetic_run.hpp"
#include "tests/support/scenarios.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace report;
using sixstep_tests::synthetic_run;
using sixstep_tests::SyntheticRun;
using ::testing::HasSubstr;

std::string page(const SyntheticRun& run) { return glance_section(run.scenario, run.outcome, run.trace); }

/// A step of the speed. The current rises, remains constant and falls. The times of the rows are exact
/// doubles.
SyntheticRun stepped_run() {
  SyntheticRun run = synthetic_run(0.001);
  run.scenario.control.mode = sixstep::control::Mode::speed;
  run.scenario.control.speed.torque_limit_Nm = 0.335;
  run.scenario.pwm.period_s = 1.0 / 1024;
  run.trace.columns = {{"t_s", "s", "", ""},
                       {"i_m_A", "A", "", ""},
                       {"i_ref_A", "A", "", ""},
                       {"speed_ref_rad_s", "rad/s", "", ""},
                       {"speed_rad_s", "rad/s", "", ""},
                       {"duty", "1", "", ""},
                       {"gate_T1", "1", "", ""}};
  run.trace.values = {{0, 1, 1, 2, 3, 3, 8, 9},      {0, 0, 0, 6, 6, 6, 0, 0},
                      {0, 0, 10, 10, 10, 0, 0, 0},   {0, 0, 50, 50, 50, 50, 50, 60},
                      {0, 0, 0, 25, 50, 50, 50, 50}, {0, 0, 1, 1, 1, -0.5, -0.5, 0},
                      {0, 0, 1, 1, 0, 1, 1, 0}};
  return run;
}

TEST(Highlights, the_largest_step_is_found_with_its_current) {
  const SyntheticRun run = stepped_run();
  const auto step = largest_step(run.trace, run.scenario);
  ASSERT_TRUE(step);
  EXPECT_EQ(step->of, "speed");
  EXPECT_EQ(step->at_s, 1.0);
  EXPECT_EQ(step->from, 0.0);
  EXPECT_EQ(step->to, 50.0);
  EXPECT_EQ(step->next_s, 9.0);
  EXPECT_EQ(step->window.to, 2.5);  // the last row off the goal is 1 s after the step
  EXPECT_TRUE(step->done);
  const auto current = step_current(run.trace, *step);
  ASSERT_TRUE(current);
  EXPECT_EQ(current->peak_A, 6.0);
  EXPECT_EQ(current->peak_after_s, 1.0);
  EXPECT_EQ(current->asked_A, 10.0);
  // The current rises from 0 to 6 A in 1 s and is 6 A for 0.5 s, until the end of the window. The integral of
  // i^2 is 12 + 18 A^2 s.
  EXPECT_DOUBLE_EQ(current->rms_A, std::sqrt(30.0 / 1.5));
  // The current is 6 A for 0.5 s, falls to 0 in 5 s, and is then 0. Its integral is 18 A s in 6.5 s.
  EXPECT_DOUBLE_EQ(*current->then_mean_A, 18.0 / 6.5);
  EXPECT_EQ(current->then_low_A, 0.0);
  EXPECT_EQ(current->then_high_A, 6.0);
}

/// A current step ends at the first Hall edge after the current has come near its goal. Any later peak is
/// caused by a commutation.
TEST(Highlights, a_current_step_ends_where_commutations_of_a_steady_current_begin) {
  SyntheticRun run = stepped_run();
  run.scenario.control.mode = sixstep::control::Mode::current;
  run.trace.columns = {
      {"t_s", "s", "", ""}, {"i_m_A", "A", "", ""}, {"i_ref_A", "A", "", ""}, {"hall", "1", "", ""}};
  run.trace.values = {{0, 1, 2, 3, 4, 5, 6, 7},
                      {0, 1, 3, 4.2, 4, 2, 5, 4},
                      {4, 4, 4, 4, 4, 4, 4, 4},
                      {5, 4, 4, 4, 4, 6, 6, 6}};
  const auto step = largest_step(run.trace, run.scenario);
  ASSERT_TRUE(step);
  EXPECT_EQ(step->of, "current");
  EXPECT_LE(step->window.to, 4.0);
  EXPECT_GE(step->window.to, 3.0);
  const auto current = step_current(run.trace, *step);
  ASSERT_TRUE(current);
  EXPECT_EQ(current->peak_A, 4.2);
  EXPECT_EQ(current->peak_after_s, 3.0);
  // Without Hall edges, every deviation from the goal belongs to the step.
  run.trace.values[3] = {4, 4, 4, 4, 4, 4, 4, 4};
  EXPECT_EQ(step_current(run.trace, *largest_step(run.trace, run.scenario))->peak_A, 5.0);
}

/// Sets every quantity of a data sheet to 1.
class AllQuantities final : public sixstep::base::Visitor {
 public:
  std::size_t count = 0;

 private:
  void visit_quantity(std::string_view, const sixstep::base::QuantityMember& member,
                      const sixstep::base::About&) override {
    ++count;
    if (const auto* of = std::get_if<std::optional<sixstep::base::Quantity>*>(&member))
      (*of)->emplace().value = 1.0;
  }
};

TEST(Parameters, each_line_of_the_data_sheet_has_its_row) {
  sixstep::design::Sheet sheet;
  AllQuantities given;
  sixstep::design::describe(given, sheet);
  EXPECT_GT(given.count, 30u);
  const std::string html = sheet_section(sheet), row = "<tr><th scope=\"row\">";
  std::size_t rows = 0;
  for (std::size_t at = html.find(row); at != std::string::npos; at = html.find(row, at + 1)) ++rows;
  EXPECT_EQ(rows, given.count);
}

/// In a field-oriented drive, the current step of a report is a step of i_q, the controlled current. The page
/// shows i_q.
TEST(Highlights, a_field_oriented_drive_steps_across_the_magnet) {
  SyntheticRun run = stepped_run();
  run.scenario.control.mode = sixstep::control::Mode::current;
  run.scenario.control.drive = sixstep::study::FirmwareKind::field;
  run.trace.columns.push_back({"i_q_ref_A", "A", "", ""});
  run.trace.columns.push_back({"i_q_A", "A", "", ""});
  run.trace.values.push_back({0, 0, 4, 4, 4, 4, 4, 4});
  run.trace.values.push_back({0, 0, 0, 2, 4, 4, 4, 4});
  const auto step = largest_step(run.trace, run.scenario);
  ASSERT_TRUE(step);
  EXPECT_EQ(step->of, "current");
  EXPECT_EQ(step->to, 4.0);
  EXPECT_EQ(step->at_s, 1.0);
  const auto held = step_current(run.trace, *step);
  ASSERT_TRUE(held);
  EXPECT_EQ(held->peak_A, 2.0);  // i_q, in A, in the window, which ends half a second later; i_m reaches 6 A
                                 // there
  EXPECT_EQ(held->asked_A, 4.0);
  const Groups groups = chart_groups(run.trace, run.scenario);
  EXPECT_EQ(std::ranges::find(groups.charts, "currents", &Group::id), groups.charts.end())
      << "it would hold i_m, and no pair is driven";
  const auto shown = std::ranges::find(groups.charts, "rotor-currents", &Group::id);
  ASSERT_NE(shown, groups.charts.end());
  EXPECT_EQ(shown->curves.size(), 2u);
  run.scenario.control.drive = sixstep::study::FirmwareKind::lean;
  const Groups others = chart_groups(run.trace, run.scenario);
  EXPECT_EQ(std::ranges::find(others.charts, "rotor-currents", &Group::id), others.charts.end());
}

/// The page names each controller that runs.
TEST(Setup, names_the_controllers_that_run) {
  using namespace sixstep::study;
  const auto told = [](const Control& control) {
    Scenario s;
    s.control = control;
    const std::string html = setup_section(s);
    const auto at = html.find("<dt>Control</dt><dd>") + 20;
    return html.substr(at, html.find(", 64-bit", at) - at);
  };
  Control c;
  c.mode = sixstep::control::Mode::speed;
  EXPECT_EQ(told(c), "speed PI → current PI");
  c.current.type = CurrentLoopType::deadbeat;
  c.speed.law = SpeedLaw::state_feedback;
  EXPECT_EQ(told(c), "speed by state feedback → deadbeat current");
  c.current.feedback = CurrentFeedback::staying_phase;
  c.speed.law = SpeedLaw::disturbance_rejection;
  EXPECT_EQ(told(c), "speed by disturbance rejection → deadbeat current on the staying phase");
  c.speed.law = SpeedLaw::sliding_mode;
  c.speed.output = SpeedOutput::duty;
  EXPECT_EQ(told(c), "speed by sliding mode → duty");
  c.mode = sixstep::control::Mode::current;
  c.current = {.type = CurrentLoopType::hysteresis, .band_A = 0.2};
  EXPECT_EQ(told(c), "current hysteresis ±200\u00a0mA, event comparator");
}

TEST(Highlights, what_held_the_run_back_is_timed) {
  SyntheticRun run = stepped_run();
  run.scenario.sheet = sixstep::testing::maxon_sheet();
  const auto held = held_back(run.trace, run.scenario);
  ASSERT_TRUE(held);
  EXPECT_EQ(held->bus_s, 2.0);
  EXPECT_EQ(held->largest_duty, 1.0);
  ASSERT_TRUE(held->limit_A);
  EXPECT_DOUBLE_EQ(*held->limit_A, 10.0);  // 0.335 Nm / 0.0335 Nm/A
  EXPECT_EQ(held->limit_s, 2.0);
  EXPECT_EQ((*turn_on_counts(run.trace))[0], 2);
}

TEST(Conduction, a_leg_without_a_gate_carries_by_the_diode_its_current_opens) {
  sixstep::study::Trace trace;
  for (const char* name :
       {"t_s", "i_a_A", "i_b_A", "i_c_A", "gate_T1", "gate_T2", "gate_T3", "gate_T4", "gate_T5", "gate_T6"})
    trace.columns.push_back({name, "", "", ""});
  // T1 and T4 drive a current from a to b. T1 switches off, and the lower diode of a conducts until the
  // current is zero. At the end, the upper diode of c conducts.
  trace.values = {{0, 1, 1, 2, 2, 3, 3, 4},  {0, 2, 2, 0, 0, 0, 0, 0}, {0, -2, -2, 0, 0, 0, 0, 1},
                  {0, 0, 0, 0, 0, 0, 0, -1}, {1, 1, 0, 0, 0, 0, 0, 0}, {0, 0, 0, 0, 0, 0, 0, 0},
                  {0, 0, 0, 0, 0, 0, 1, 1},  {1, 1, 1, 1, 0, 0, 0, 0}, {0, 0, 0, 0, 0, 0, 0, 0},
                  {0, 0, 0, 0, 0, 0, 0, 0}};
  const Conduction found = conduction(trace);
  EXPECT_THAT(found.time_s, ::testing::ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(found.code, ::testing::ElementsAre(1 + 5 * 2, 4 + 5 * 2, 0, 5 * 1 + 25 * 3));
  EXPECT_EQ(found.end_s, 4.0);
}

TEST(Conduction, an_igbt_that_is_on_carries_one_direction_and_its_diode_the_other) {
  sixstep::study::Trace trace;
  for (const char* name :
       {"t_s", "i_a_A", "i_b_A", "i_c_A", "gate_T1", "gate_T2", "gate_T3", "gate_T4", "gate_T5", "gate_T6"})
    trace.columns.push_back({name, "", "", ""});
  // T1, T4 and T6 are on. The current enters at a. It returns at b through the transistor, and at c through
  // the lower diode. Then it is zero.
  trace.values = {{0, 1, 1, 2}, {2, 2, 0, 0}, {-3, -3, 0, 0}, {1, 1, 0, 0}, {1, 1, 1, 1},
                  {0, 0, 0, 0}, {0, 0, 0, 0}, {1, 1, 1, 1},   {0, 0, 0, 0}, {1, 1, 1, 1}};
  EXPECT_THAT(conduction(trace, true).code, ::testing::ElementsAre(1 + 5 * 2 + 25 * 4, 0));
  EXPECT_THAT(conduction(trace).code, ::testing::ElementsAre(1 + 5 * 2 + 25 * 2));
}

TEST(Conduction, a_leg_carries_the_current_of_the_phase_that_hangs_at_it) {
  sixstep::study::Trace trace;
  for (const char* name :
       {"t_s", "i_a_A", "i_b_A", "i_c_A", "gate_T1", "gate_T2", "gate_T3", "gate_T4", "gate_T5", "gate_T6"})
    trace.columns.push_back({name, "", "", ""});
  // No gate is on. The current enters phase a and returns from phase b. Legs a, b, c are connected to phases
  // b, c, a. Therefore leg a carries the current of phase b through its upper diode, and leg c carries the
  // current of phase a.
  trace.values = {{0, 1}, {2, 2}, {-2, -2}, {0, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}};
  EXPECT_THAT(conduction(trace).code, ::testing::ElementsAre(4 + 5 * 3));
  EXPECT_THAT(conduction(trace, false, {1, 2, 0}).code, ::testing::ElementsAre(3 + 25 * 4));
}

TEST(Glance, answers_what_a_reader_asks_first) {
  SyntheticRun run = synthetic_run(0.02);
  std::string html = page(run);
  EXPECT_THAT(html,
              HasSubstr("Closest requirement</dt><dd>largest current: 1.5\u00a0% inside its upper limit"));
  EXPECT_THAT(html, HasSubstr("Current in its step from 5\u00a0A to −5\u00a0A"));
  EXPECT_THAT(html, HasSubstr("given as d1, d0; pole placement gives 4.0956, −3.694"));
  EXPECT_THAT(html, HasSubstr("<h2>Costs</h2>"));
  EXPECT_THAT(html, HasSubstr("chopped at <b>"));
  run.scenario.control.current.type = sixstep::study::CurrentLoopType::hysteresis;
  run.scenario.control.current.band_A = 0.25;
  run.outcome.gains.clear();
  EXPECT_THAT(page(run), HasSubstr("hysteresis, ±250.0\u00a0mA"));
  run.outcome.verdicts[2].ok = false;
  EXPECT_THAT(page(run), HasSubstr("Not met</dt><dd>mean current from 2 ms to 5 ms"));
}

/// The zero of the Celsius scale is arbitrary. With another zero, the margin to the limit and its text are
/// the same.
TEST(Glance, a_temperature_has_no_percentage) {
  const sixstep::study::Verdict upper{"housing", "degC", 46, {}, 85.0, true, 25.0},
      lower{"housing", "degC", 46, 30.0, {}, true, 25.0};
  for (sixstep::study::Verdict v : {upper, lower}) {
    const double before = *room(v);
    const std::string words = room_words(v);
    EXPECT_THAT(words, HasSubstr("\u00a0K inside its "));
    EXPECT_EQ(words.find('%'), words.npos);
    for (std::optional<double>* bound : {&v.min, &v.max})
      if (*bound) **bound += 273.15;
    v.measured += 273.15;
    v.zero += 273.15;
    EXPECT_NEAR(*room(v), before, 1e-12);
    EXPECT_EQ(room_words(v), words);
  }
  EXPECT_NEAR(*room(upper), (85.0 - 46.0) / (85.0 - 25.0), 1e-12);
  EXPECT_EQ(deviation(46, 40, "degC"), deviation(46 + 273.15, 40 + 273.15, "degC"));
}

/// For a controller without a PI, the page shows the controller's own parameter, such as the band.
TEST(Gains, of_a_hysteresis_are_its_band) {
  SyntheticRun run = synthetic_run(0.002);
  run.outcome.gains.clear();
  run.scenario.control.current.type = sixstep::study::CurrentLoopType::hysteresis;
  for (const double band : {0.2, 1.5}) {
    run.scenario.control.current.band_A = band;
    const std::string html = gains_section(run.scenario, run.outcome);
    EXPECT_THAT(html, HasSubstr(computed(band, "A")));
    EXPECT_THAT(page(run), HasSubstr(computed(band, "A")));
  }
  run.scenario.control.mode = sixstep::control::Mode::duty;
  EXPECT_THAT(gains_section(run.scenario, run.outcome), HasSubstr(without_gains(run.scenario)));
  EXPECT_EQ(gains_section(run.scenario, run.outcome).find("hysteresis"), std::string::npos);
}

/// A current of the size of rounding errors counts as no current.
TEST(Glance, a_step_tells_no_rounding_errors) {
  SyntheticRun run = stepped_run();
  for (double& x : run.trace.values[1])
    if (x == 0) x = 1e-28;
  EXPECT_EQ(page(run).find("pA"), std::string::npos) << page(run);
  EXPECT_EQ(page(run).find("·10"), std::string::npos);
}

TEST(PackedRows, keep_the_range_in_65533_steps_with_zero_on_one_and_refuse_what_is_too_much) {
  const std::vector<double> time{0, 1e-6, 1e-6, 5}, held{2, 2, 2, 2}, moving{-1, 0, 2, NAN};
  const auto packed = packed_rows(time, {&held, &moving}, 1000);
  ASSERT_TRUE(packed);
  EXPECT_EQ(packed->rows, 4u);
  EXPECT_GE(packed->tick_s * 4294967295.0, 5.0) << "the longest gap fits into 32 bits";
  EXPECT_EQ(packed->columns[0].low, 2.0);
  EXPECT_EQ(packed->columns[0].step, 0.0);
  EXPECT_EQ(packed->columns[1].step, 3.0 / 65533);
  const double zero = -packed->columns[1].low / packed->columns[1].step;
  EXPECT_EQ(zero, std::round(zero));
  EXPECT_FALSE(packed_rows(time, {&held, &moving}, 10));
}

/// A sawtooth with `turns` teeth from -1 to 1 in one second. It has rows only at its jumps.
struct Saw {
  std::vector<double> time, values;
};
Saw saw(int turns) {
  Saw out;
  for (int n = 0; n < turns; ++n)
    for (const int side : {0, 1}) {
      out.time.push_back((n + side) / static_cast<double>(turns));
      out.values.push_back(side ? 1.0 : -1.0);
    }
  return out;
}

TEST(Spectrum, of_a_saw_is_the_fourier_series) {
  // 37 is not a power of two, so teeth and jumps do not align with the cells. The amplitude of harmonic n is
  // 2/(pi n).
  constexpr int turns = 37, cells = 4096;
  const Saw s = saw(turns);
  const Lines lines = lines_of(s.time, s.values, {0, 1}, 1.0 / cells);
  EXPECT_EQ(lines.cell_s, 1.0 / cells);
  EXPECT_EQ(lines.spacing_Hz, 1.0);
  ASSERT_EQ(lines.amplitude.size(), cells / 8 + 1u);
  for (int n = 1; n * turns + 1 < cells / 8; ++n) {
    const auto k = static_cast<std::size_t>(n * turns);
    // Sampling by cells aliases the harmonics at m cells -+ k (m = 1, 2, ..) to line k. The mean over a cell
    // multiplies each of these harmonics by k/(m cells -+ k), and the correction divides by the factor of
    // line k. The aliased amplitudes are at most 2/pi turns/(m cells - k). Their sum is below 2/pi turns
    // k/cells^2 times twice the sum of 1/(m - 1/8)^2, and this doubled sum is less than 4.
    const double folded = 4 * 2 / M_PI * turns * (n * turns) / (static_cast<double>(cells) * cells);
    EXPECT_NEAR(lines.amplitude[k], 2 / (M_PI * n), folded + 1e-12) << n;
    EXPECT_NEAR(lines.amplitude[k + 1], 1 / (M_PI * n), folded + 1e-12) << "Hann: half of it beside the line";
  }
  for (const std::size_t k : {5u, 20u, 55u}) EXPECT_LT(lines.amplitude[k], 1e-2) << "between the harmonics";
  ASSERT_GE(lines.tones.size(), 3u);
  for (std::size_t n = 0; n < 3; ++n)
    EXPECT_NEAR(lines.tones[n].line, turns * (static_cast<double>(n) + 1), 1e-3);
}

/// The interval does not contain a whole number of teeth, so every harmonic is between two lines. The
/// spectrum still shows the frequency and the amplitude of the harmonic.
TEST(Spectrum, a_tone_between_two_lines_has_its_own_amplitude_and_frequency) {
  const Saw s = saw(37);
  for (const double end : {0.9871, 0.9932, 0.9999}) {
    const Lines lines = lines_of(s.time, s.values, {0, end}, 1.0 / 16384);
    ASSERT_GE(lines.tones.size(), 8u);
    for (int n = 1; n <= 8; ++n) {
      const Tone& tone = lines.tones[static_cast<std::size_t>(n - 1)];
      EXPECT_NEAR(tone.line * lines.spacing_Hz, 37.0 * n, 0.01 * lines.spacing_Hz) << end << ' ' << n;
      EXPECT_NEAR(tone.amplitude, 2 / (M_PI * n), 2e-3 / n) << end << ' ' << n;
      const auto k = static_cast<std::size_t>(std::lround(tone.line));
      EXPECT_EQ(std::max(lines.amplitude[k], lines.amplitude[k - 1]), tone.amplitude) << "in the chart too";
    }
  }
}

TEST(Spectrum, a_weak_tone_near_a_strong_one_is_found_and_leakage_is_none) {
  const auto tones = [](double weak) {
    std::vector<double> time, values;
    for (int n = 0; n <= 4096; ++n) {
      const double t = n / 4096.0;
      time.push_back(t);
      values.push_back(std::sin(2 * M_PI * 20.4 * t) + weak * std::sin(2 * M_PI * 23.9 * t + 1));
    }
    return lines_of(time, values, {0, 1}, 1.0 / 4096).tones;
  };
  EXPECT_EQ(tones(0.0).size(), 1u);
  const std::vector<Tone> both = tones(0.2);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_NEAR(both[1].line, 23.9, 0.2);
  EXPECT_NEAR(both[1].amplitude, 0.2, 0.03);
}

TEST(Spectrum, a_drift_is_no_tone) {
  std::vector<double> time, values;
  for (int n = 0; n <= 4096; ++n) {
    const double t = n / 4096.0;
    time.push_back(t);
    values.push_back(std::exp(-3 * t) + 0.05 * std::sin(2 * M_PI * 30 * t));
  }
  const std::vector<Tone> tones = lines_of(time, values, {0, 1}, 1.0 / 4096).tones;
  ASSERT_EQ(tones.size(), 1u);
  EXPECT_NEAR(tones[0].line, 30, 0.05);
}

TEST(Spectrum, is_taken_over_whole_electrical_turns_of_the_last_setpoint) {
  SyntheticRun run = stepped_run();
  run.trace.columns.push_back({"angle_rad", "rad", "", ""});
  run.trace.values.push_back({0, 0, 0, 0, 0, 0, 0, 0});
  auto& time = run.trace.values[0];
  auto& angle = run.trace.values.back();
  auto& reference = run.trace.values[3];
  for (std::size_t n = 0; n < time.size(); ++n) {
    angle[n] = time[n] * 0.6 * M_PI;  // 0.6 electrical turns per second with two pole pairs
    reference[n] = time[n] < 1 ? 0 : 50;
  }
  const auto found = steady_stretch(run.trace, run.scenario, 2);
  ASSERT_TRUE(found);  // from the second row at 1 s to 9 s: the later half has 2.4 turns
  EXPECT_EQ(found->turns, 2);
  EXPECT_NEAR(found->time.from, 9 - 2 / 0.6, 8 * 9 * 2.3e-16);  // a few roundings of numbers up to 9
  EXPECT_EQ(found->time.to, 9.0);
  run.scenario.pwm.period_s = 0.1;  // 40 periods are too few for a spectrum
  EXPECT_FALSE(steady_stretch(run.trace, run.scenario, 2));
}

TEST(Spectrum, lines_are_called_by_what_they_come_from) {
  // The interval of the spectrum contains 10 electrical turns and 1000 PWM periods.
  EXPECT_EQ(origin_of(60, {10, 1000}).name, "6 × electrical");
  EXPECT_EQ(origin_of(1000, {10, 1000}).name, "PWM");
  EXPECT_EQ(origin_of(2000, {0, 1000}).name, "2 × PWM");
  EXPECT_EQ(origin_of(980, {10, 1000}).name, "PWM − 2 × electrical");
  EXPECT_EQ(origin_of(1004, {10, 1000}).name, "beside PWM");
  EXPECT_EQ(origin_of(65, {10, 1000}).name, "");
  EXPECT_EQ(origin_of(65, {0, 0}).name, "");
  EXPECT_EQ(origin_of(10, {10, 1000}).name, "electrical, the fundamental");
  // With three turns, a side line is three lines away from the line of the PWM. A tone 2.5 lines away is not
  // a side line.
  EXPECT_EQ(origin_of(1002.5, {3, 1000}).name, "");
  EXPECT_EQ(origin_of(1003.1, {3, 1000}).name, "PWM + electrical");
  // A tone with a known cause is shown at the line of this cause. Any other tone is shown at the line at
  // which it was found.
  EXPECT_EQ(origin_of(1003.1, {3, 1000}).line, 1003.0);
  EXPECT_EQ(origin_of(5.94, {6, 1000}).line, 6.0);
  EXPECT_EQ(origin_of(65.2, {10, 1000}).line, 65.2);
  EXPECT_EQ(origin_of(65.2, {0, 1000, 65}).name, "step of the thermal model");
  EXPECT_EQ(origin_of(130, {0, 1000, 65}).name, "2 × step of the thermal model");
}

TEST(Spectrum, of_few_turns_the_harmonics_are_named_on_their_own_lines) {
  for (const long long turns : {1, 2, 3, 4, 5, 6}) {
    const auto t = static_cast<double>(turns);
    EXPECT_EQ(origin_of(t, {turns, 1000}).name, "electrical, the fundamental") << turns;
    EXPECT_EQ(origin_of(5 * t, {turns, 1000}).name, "5 × electrical") << turns;
    EXPECT_EQ(origin_of(6 * t, {turns, 1000}).name, "6 × electrical") << turns;
    if (turns > 1) {
      EXPECT_EQ(origin_of(5 * t + 1, {turns, 1000}).name, "") << "between two multiples of " << turns;
    }
  }
}

TEST(Spectrum, a_drawn_chart_keeps_the_highest_line_of_each_step) {
  Lines lines{.spacing_Hz = 2, .amplitude = std::vector<double>(30001, 1e-3)};
  lines.amplitude[29000] = 5;
  const Drawn drawn = drawn_lines(lines);
  EXPECT_LE(drawn.amplitude.size(), 1501u);
  EXPECT_EQ(drawn.frequency_Hz.front(), 2.0);
  EXPECT_TRUE(std::ranges::is_sorted(drawn.frequency_Hz));
  const auto peak = std::ranges::max_element(drawn.amplitude) - drawn.amplitude.begin();
  EXPECT_EQ(drawn.frequency_Hz[static_cast<std::size_t>(peak)], 58000.0);
}

}  // namespace SIXSTEP_TEST_FILE
