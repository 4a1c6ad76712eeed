// SPDX-License-Identifier: Apache-2.0
// Tests the text of a spectrum in which nothing oscillates.
#include "report/spectra.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace SIXSTEP_TEST_FILE {

using namespace report;
using ::testing::HasSubstr;
using ::testing::Not;

/// A run of one second with two curves. Its rows are 1/1024 s apart.
sixstep::study::Trace trace_of(double (*current)(double), double (*torque)(double)) {
  sixstep::study::Trace trace;
  for (const char* name : {"t_s", "i_a_A", "torque_Nm"}) trace.columns.push_back({name, "", "", ""});
  trace.values.resize(3);
  for (int n = 0; n <= 1024; ++n) {
    const double t = n / 1024.0;
    trace.values[0].push_back(t);
    trace.values[1].push_back(current(t));
    trace.values[2].push_back(torque(t));
  }
  return trace;
}
sixstep::study::Scenario scenario() {
  sixstep::study::Scenario s;
  s.pwm.period_s = 1.0 / 1024;
  return s;
}
double rounding(double t) { return 2.7e-42 * std::sin(2 * M_PI * 100 * t); }
double drift(double t) { return 1e-3 * t; }
double tone(double t) { return 2e-9 * std::sin(2 * M_PI * 100 * t); }

TEST(Spectra, of_what_is_not_there_there_is_none) {
  EXPECT_FALSE(spectra(trace_of(rounding, rounding), scenario(), 2));
  const auto one = spectra(trace_of(rounding, tone), scenario(), 2);
  ASSERT_TRUE(one);
  ASSERT_EQ(one->all.size(), 1u);
  EXPECT_EQ(one->all[0].id, "torque-spectrum");
  EXPECT_THAT(spectra_section(one), HasSubstr("100.0\u00a0Hz"));
  EXPECT_THAT(spectra_section(one), Not(HasSubstr("phase current")));
}

TEST(Spectra, of_a_drift_alone_no_line_stands_out) {
  const std::string html = spectra_section(spectra(trace_of(rounding, drift), scenario(), 2));
  EXPECT_THAT(html,
              HasSubstr("<h3>Spectrum of the torque</h3><p class=\"quiet\">No line exceeds the noise.</p>"));
  EXPECT_THAT(html, Not(HasSubstr("<table")));
}

/// The later half of the run has `turned` electrical turns of a rotor with two pole pairs. With one turn, the
/// fundamental would be the first line, which the spectrum omits.
TEST(Spectra, fewer_than_two_electrical_turns_are_told) {
  for (const double turned : {0.38, 0.0, 1.2, 2.4}) {
    sixstep::study::Trace trace = trace_of(rounding, tone);
    trace.columns.push_back({"angle_rad", "", "", ""});
    trace.values.emplace_back();
    for (const double t : trace.values[0]) trace.values.back().push_back(2 * t * turned * 2 * M_PI / 2);
    const std::string html = spectra_section(spectra(trace, scenario(), 2));
    EXPECT_EQ(html.find("has only 0.38 electrical turns") != std::string::npos, turned == 0.38) << html;
    EXPECT_EQ(html.find("has only 1.2 electrical turns") != std::string::npos, turned == 1.2) << html;
    EXPECT_EQ(html.find("fewer than two") != std::string::npos, turned > 0.0 && turned < 2.0) << html;
  }
}

/// The interval contains whole electrical turns. The fundamental is therefore the number of turns divided by
/// the duration of the interval, even if a neighbouring tone is strong.
TEST(Spectra, the_fundamental_is_the_number_of_turns_over_their_time) {
  sixstep::study::Trace trace = trace_of(
      [](double t) { return std::sin(2 * M_PI * 12 * t) + 0.3 * std::sin(2 * M_PI * 9.7 * t); }, rounding);
  trace.columns.push_back({"angle_rad", "", "", ""});
  trace.values.emplace_back();
  for (const double t : trace.values[0]) trace.values.back().push_back(12 * t * 2 * M_PI / 2);
  const auto found = spectra(trace, scenario(), 2);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->stretch.turns, 6);
  EXPECT_GT(std::abs(found->all[0].lines.tones[0].line - 6), 0.01) << "the neighbour draws it";
  EXPECT_THAT(spectra_section(found), HasSubstr("12.00\u00a0Hz</td>"));
}

/// A thermal step of 10 ms changes the resistance 100 times per second.
TEST(Spectra, the_steps_of_the_thermal_model_are_named) {
  sixstep::study::Scenario s = scenario();
  s.heat.step_s = 0.01;
  EXPECT_THAT(spectra_section(spectra(trace_of(rounding, tone), s, 2)), Not(HasSubstr("thermal model")));
  s.heat.motor = true;
  EXPECT_THAT(spectra_section(spectra(trace_of(rounding, tone), s, 2)),
              HasSubstr("<td>step of the thermal model</td>"));
}

/// Two diodes in series conduct in each half of the mains period. The bus voltage therefore pulsates at twice
/// 50 Hz and at multiples of this frequency.
TEST(Spectra, multiples_of_twice_the_mains_are_named) {
  EXPECT_EQ(origin_of(100.1, {.mains = 50.0}).name, "2 × mains");
  EXPECT_EQ(origin_of(100.1, {.mains = 50.0}).line, 100.0);
  EXPECT_EQ(origin_of(300.0, {.mains = 50.0}).name, "6 × mains");
  EXPECT_EQ(origin_of(150.0, {.mains = 50.0}).name, "");
  EXPECT_EQ(origin_of(100.0, {}).name, "");
}

/// A current between the two levels of a hysteresis band rises and falls with different slopes: its rise
/// takes 40 % of the period, its fall 60 %. The frequency is 50.3 Hz. The comparators' duty determines the
/// frequency, and each multiple is named after the comparators.
TEST(Spectra, lines_of_comparators_are_named_by_their_own_frequency) {
  constexpr double hertz = 50.3;
  sixstep::study::Trace trace;
  for (const char* name : {"t_s", "i_a_A", "torque_Nm", "duty"}) trace.columns.push_back({name, "", "", ""});
  trace.values.resize(4);
  const auto row = [&trace](double t, double current, double duty) {
    const double cells[] = {t, current, 0.0, duty};
    for (std::size_t c = 0; c < 4; ++c) trace.values[c].push_back(cells[c]);
  };
  for (int n = 0; n < 51; ++n) {
    row(n / hertz, -0.2, 0);
    row(n / hertz, -0.2, 1);
    row((n + 0.4) / hertz, 0.2, 1);
    row((n + 0.4) / hertz, 0.2, 0);
  }
  sixstep::study::Scenario s = scenario();
  s.control.mode = sixstep::control::Mode::current;
  s.control.current.type = sixstep::study::CurrentLoopType::hysteresis;
  const auto found = spectra(trace, s, 2);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->switching_Hz, hertz, 1e-9);
  const std::string html = spectra_section(found);
  EXPECT_THAT(html, HasSubstr("<td>switching</td>"));
  EXPECT_THAT(html, HasSubstr("<td>2 × switching</td>"));
  EXPECT_THAT(html, HasSubstr("50.30\u00a0Hz</td>"));
  EXPECT_THAT(html, Not(HasSubstr("PWM</td>")));
  EXPECT_EQ(origin_of(52.0, {.switchings = 50.3}).name, "beside switching");
  EXPECT_EQ(origin_of(75.0, {.switchings = 50.3}).name, "");
}

TEST(Spectra, a_tone_is_one_from_a_billionth_of_its_unit_on) {
  for (const double amplitude : {0.9e-9, 1.1e-9, 1e-3}) {
    std::vector<double> time, values;
    for (int n = 0; n <= 4096; ++n) {
      time.push_back(n / 4096.0);
      values.push_back(amplitude * std::sin(2 * M_PI * 20 * time.back()));
    }
    const std::vector<Tone> tones = lines_of(time, values, {0, 1}, 1.0 / 4096).tones;
    EXPECT_EQ(tones.size(), amplitude < 1e-9 ? 0u : 1u) << amplitude;
  }
}

}  // namespace SIXSTEP_TEST_FILE
