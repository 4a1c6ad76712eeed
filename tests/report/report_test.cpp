// SPDX-License-Identifier: Apache-2.0
#include "report/report.hpp"

#include <gmock/gmock.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>

#include "report/energy_balance.hpp"
#include "report/figures.hpp"
#include "report/html.hpp"
#include "report/plots.hpp"
#include "report/thinning.hpp"
#include "report/windows.hpp"
#include "sixstep/base/written.hpp"
#include "tests/report/synthetic_run.hpp"
#include "text/results/json_summary.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace report;
using sixstep_tests::synthetic_run;
using sixstep_tests::SyntheticRun;
using ::testing::HasSubstr;
using ::testing::Not;

std::string page(const SyntheticRun& run, const std::string& text = "title = \"x\"") {
  return render({.scenario = run.scenario,
                 .outcome = run.outcome,
                 .trace = run.trace,
                 .command = "sixstep run x.toml --html x.html",
                 .version = "0.1.0",
                 .scenario_text = text});
}

/// The data in the page, as the page's script reads them.
nlohmann::json data_of(const std::string& html) {
  const std::string open = R"(<script type="application/json" id="data">)";
  const std::size_t begin = html.find(open) + open.size();
  return nlohmann::json::parse(html.substr(begin, html.find("</script>", begin) - begin));
}

template <class Bits, class Real>
std::vector<Real> decoded(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t window = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    window = window << 6 | static_cast<std::uint32_t>(digits.find(c));
    if ((bits += 6) >= 8) bytes += static_cast<char>(window >> (bits -= 8) & 0xffu);
  }
  std::vector<Real> values;
  for (std::size_t n = 0; n + sizeof(Real) <= bytes.size(); n += sizeof(Real)) {
    Bits b = 0;
    for (std::size_t k = 0; k < sizeof(Real); ++k)
      b |= static_cast<Bits>(static_cast<unsigned char>(bytes[n + k])) << (8 * k);
    values.push_back(std::bit_cast<Real>(b));
  }
  return values;
}

TEST(Report, a_users_controller_shows_every_number_with_unit_and_origin) {
  static constexpr sixstep_parameter numbers[] = {{"kp", "V s/rad", "gain of the error", 0.25, 0.0, 5.0},
                                                  {"track_s", "s", "time of <tracking>", 0.01, 0.0, 3.0}};
  static sixstep_controller own{};
  own.name = "my PI";
  own.parameters = 2;
  own.parameter = numbers;
  SyntheticRun run = synthetic_run(0.001);
  run.scenario.control.drive = sixstep::study::FirmwareKind::own;
  run.scenario.control.own.loaded = &own;
  run.scenario.control.own.number = {{"kp", 0.5}};
  run.outcome.gains.clear();
  const std::string html = page(run);
  EXPECT_THAT(html, HasSubstr("kp</th><td class=\"num\">0.5\u00a0V s/rad</td><td>scenario</td>"));
  EXPECT_THAT(
      html,
      HasSubstr("track_s</th><td class=\"num\">10\u00a0ms</td><td>preset</td><td>time of &lt;tracking"));
  EXPECT_THAT(html, HasSubstr("track_s 10\u00a0ms (preset)"));
  const nlohmann::json told = nlohmann::json::parse(text::json_summary(run.scenario, run.outcome));
  EXPECT_EQ(told["own"]["numbers"],
            nlohmann::json::parse(R"([{"name": "kp", "value": 0.5, "unit": "V s/rad", "preset": false},
                                      {"name": "track_s", "value": 0.01, "unit": "s", "preset": true}])"));
}

TEST(Report, foreign_text_stays_text) {
  SyntheticRun run = synthetic_run(0.001);
  run.scenario.title = "<b>bold</b> & \"quoted\"";
  run.trace.columns[1].meaning = "</script><script>alert(1)</script>";
  run.outcome.verdicts[0].figure = "<img src=x onerror=alert(1)>";
  const std::string html = page(run, "# </pre><script>alert(2)</script> {{data}}");
  EXPECT_THAT(html, HasSubstr("&lt;b&gt;bold&lt;/b&gt; &amp; &quot;quoted&quot;"));
  EXPECT_THAT(html, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(html, Not(HasSubstr("<img src=x")));
  EXPECT_THAT(html, HasSubstr("&lt;script&gt;alert(2)&lt;/script&gt; {{data}}"));
  EXPECT_EQ(data_of(html)["charts"][0]["curves"][1]["meaning"], "</script><script>alert(1)</script> (phase)");
}

TEST(Report, needs_no_network) {
  const std::string html = page(synthetic_run(0.001));
  EXPECT_THAT(html, Not(HasSubstr("src=")));
  EXPECT_THAT(html, Not(HasSubstr("@import")));
  EXPECT_THAT(html, Not(HasSubstr("href=\"http")));
}

TEST(Report, same_input_gives_same_bytes) {
  EXPECT_EQ(page(synthetic_run(0.002)), page(synthetic_run(0.002)));
}

TEST(Report, stays_small_enough_to_send) {
  EXPECT_LT(page(synthetic_run(0.02)).size(), 1u << 20);
  const std::string longer = page(synthetic_run(0.6));
  EXPECT_LT(longer.size(), 6u << 20);  // 10 MiB a simulated second, with every row
  const auto data = data_of(longer);
  EXPECT_FALSE(data["conduction"].contains("time")) << "what conducts comes with the rows";
  EXPECT_EQ(data["rows"][0]["columns"].size(),
            1 + std::accumulate(data["charts"].begin(), data["charts"].end(), std::size_t{0},
                                [](std::size_t n, const auto& chart) { return n + chart["curves"].size(); }));
}

TEST(Report, shows_the_digest) {
  EXPECT_EQ(sixstep::base::written_hex(0x0123456789abcdefu), "0123456789abcdef");
  EXPECT_EQ(sixstep::base::written_hex(0xf00du), "000000000000f00d");
  EXPECT_EQ(sixstep::base::written_hex(0), "0000000000000000");
  sixstep::study::Outcome out;
  out.digest = 0xabcu;
  EXPECT_THAT(report::event_section(out), HasSubstr("0000000000000abc"));
}

TEST(Report, survives_a_run_without_a_trace) {
  SyntheticRun run = synthetic_run(0.001);
  run.trace = {};
  run.outcome.verdicts.clear();
  run.outcome.fault = sixstep::base::Problem{"hall", "000", "is no valid code", "check the wires"};
  const std::string html = page(run);
  EXPECT_THAT(html, HasSubstr("FAIL"));
  EXPECT_THAT(html, HasSubstr("hall = 000 is no valid code; check the wires"));
  EXPECT_TRUE(data_of(html)["charts"].empty());
}

TEST(Report, shows_what_is_not_ideal_and_who_stopped_the_drive) {
  SyntheticRun run = synthetic_run(0.001);
  const std::string plain = page(run);
  for (const char* row : {"<dt>Sensors", "<dt>Product drive"}) EXPECT_THAT(plain, Not(HasSubstr(row)));
  run.scenario.control.drive = sixstep::study::FirmwareKind::product;
  run.scenario.sensors.currents = sixstep::rig::CurrentMeasurement::phases;
  run.scenario.sensors.current_range_A = 20.48;
  run.scenario.sensors.hall_break = {.at_s = 0.3, .line = 2};
  run.scenario.protection.over_current_A = 15.0;
  run.outcome.fault = sixstep::base::Problem{"t = 0.305 s", "", "the drive tripped", "look"};
  run.outcome.trip = sixstep::study::Trip{.at_s = 0.305, .reasons = {"a Hall fault"}, .hall_line = 2};
  const std::string html = page(run);  // the page keeps each number and its unit together
  EXPECT_THAT(html, HasSubstr("phase currents through 12 bits over ±20.48\u00a0A"));
  EXPECT_THAT(html, HasSubstr("line H2 reads low from 300\u00a0ms on"));
  run.scenario.at = {{.time_s = 0.1}, {.time_s = 0.2}};
  run.scenario.at[0].sensors.hall_break = {.line = 1, .level = sixstep::study::PinLevel::high};
  run.scenario.at[1].sensors.hall_break = {.line = 1, .level = sixstep::study::PinLevel::probe};
  EXPECT_THAT(page(run),
              HasSubstr("100\u00a0ms: line H1 reads high; 200\u00a0ms: line H1 follows its probe again"));
  EXPECT_THAT(html, HasSubstr("used, V/A</th>"));
  EXPECT_THAT(html, HasSubstr("</b> V/A<br>"));
  EXPECT_THAT(html, HasSubstr("trips above 15\u00a0A"));
  EXPECT_THAT(html, HasSubstr("a fault stopped the drive at 305\u00a0ms"));
  const auto summary = nlohmann::json::parse(text::json_summary(run.scenario, run.outcome));
  EXPECT_EQ(summary["trip"]["hall_line"], 2);
  EXPECT_EQ(summary["trip"]["at_s"], 0.305);
}

TEST(Report, curves_without_a_number_are_left_out) {
  const auto data = data_of(page(synthetic_run(0.001)));
  for (const auto& chart : data["charts"]) {
    EXPECT_NE(chart["id"], "bus");  // a stiff bus has no chart
    if (chart["id"] == "speed") {
      EXPECT_EQ(chart["curves"].size(), 1u);  // the reference is NaN throughout
    }
  }
}

TEST(Report, long_run_keeps_every_extreme_and_the_close_ups_whole) {
  const SyntheticRun run = synthetic_run(0.3);
  const auto& time = run.trace.values[0];
  const auto& current = run.trace.values[1];
  const auto data = nlohmann::json::parse(
      plot_data(run.trace, run.scenario, 8, {.cap = 3000, .full = 3000, .packed_bytes = 0}));
  const auto& chart = data["charts"][0];
  ASSERT_EQ(chart["id"], "currents");
  ASSERT_FALSE(chart["complete"]);
  const auto& of_a = chart["curves"][1];  // after i_m, which is drawn below the phases
  ASSERT_EQ(of_a["label"], "i_a");
  const auto t = decoded<std::uint64_t, double>(data["axes"][of_a["axis"].get<std::size_t>()]);
  const auto i = decoded<std::uint32_t, float>(of_a["data"]);
  ASSERT_EQ(t.size(), i.size());
  EXPECT_TRUE(std::ranges::is_sorted(t));
  EXPECT_EQ(std::ranges::max(i), static_cast<float>(std::ranges::max(current)));
  EXPECT_EQ(std::ranges::min(i), static_cast<float>(std::ranges::min(current)));
  ASSERT_EQ(data["windows"].size(), 3u);
  for (const auto& window : data["windows"]) {
    const Interval inside{window["from"], window["to"]};
    const auto count = [&](const auto& times) {
      return std::ranges::count_if(times, [&](double at) { return inside.holds(at); });
    };
    EXPECT_EQ(count(t), count(time)) << window["id"];
  }
}

TEST(Thinning, every_bucket_keeps_its_extremes) {
  std::vector<double> time, wave, spike;
  for (int n = 0; n < 50000; ++n) {
    time.push_back(n * 1e-6);
    wave.push_back(std::sin(n * 0.7));
    spike.push_back(n == 31234 ? 100.0 : n == 7 ? -50.0 : std::numeric_limits<double>::quiet_NaN());
  }
  const Thinned result = thinned(time, {wave, spike}, {}, 2000, 4000);
  EXPECT_FALSE(result.complete);
  EXPECT_LE(result.rows.size(), 2000u);
  EXPECT_THAT(result.rows, ::testing::IsSupersetOf({0u, 7u, 31234u, 49999u}));
  // In each bucket, the largest drawn value is equal to the largest value of all rows.
  for (std::size_t from = 0; from + 1000 <= time.size(); from += 1000) {
    double high = -1.0, drawn = -1.0;
    for (std::size_t n = from; n < from + 1000; ++n) high = std::max(high, wave[n]);
    for (const std::size_t n : result.rows)
      if (n >= from && n < from + 1000) drawn = std::max(drawn, wave[n]);
    EXPECT_NEAR(drawn, high, 1e-2);
  }
}

TEST(Thinning, level_stretches_cost_nothing_and_lose_nothing) {
  std::vector<double> time, step;
  for (int n = 0; n < 1000; ++n) {
    time.push_back(n);
    step.push_back(n < 500 ? 0.0 : 1.0);
  }
  EXPECT_THAT(thinned(time, {step}, {}, 10, 10).rows, ::testing::ElementsAre(0u, 499u, 500u, 999u));
}

TEST(Thinning, jumps_keep_both_sides) {
  const std::vector<double> time{0, 1, 1, 2}, value{0, 0, 5, 5};
  EXPECT_THAT(thinned(time, {value}, {}, 10, 10).rows, ::testing::ElementsAre(0u, 1u, 2u, 3u));
}

TEST(Windows, three_periods_switch_and_the_commutation_holds_a_hall_edge) {
  const SyntheticRun run = synthetic_run(0.02);
  const Windows windows = choose_windows(run.trace, run.scenario);
  ASSERT_TRUE(windows.periods);
  EXPECT_NEAR(windows.periods->to - windows.periods->from, 90e-6, 1e-12);
  ASSERT_TRUE(windows.commutation);
  const auto& hall = run.trace.values[27];
  bool edge = false;
  for (std::size_t n = 1; n < hall.size(); ++n)
    edge |= hall[n] != hall[n - 1] && windows.commutation->holds(run.trace.values[0][n]);
  EXPECT_TRUE(edge);
}

TEST(Windows, locked_rotor_has_no_commutation) {
  SyntheticRun run = synthetic_run(0.005);
  std::ranges::fill(run.trace.values[27], 4.0);
  EXPECT_FALSE(choose_windows(run.trace, run.scenario).commutation);
}

TEST(Index, names_every_experiment_and_its_verdict) {
  const SyntheticRun good = synthetic_run(0.001);
  SyntheticRun bad = synthetic_run(0.001);
  bad.outcome.verdicts[0].ok = false;
  const std::string html = render_index(
      {{"One & two", "a.html", &good.outcome}, {"Three", "b.html", &bad.outcome}}, "sixstep run", "0.1.0");
  EXPECT_THAT(html, HasSubstr("1 of 2 experiments pass"));
  EXPECT_THAT(html, HasSubstr("<a href=\"a.html\">One &amp; two</a>"));
  // The overview is at the top of the page, and each of its rows links to a section.
  const std::size_t overview = html.find("<table class=\"overview\">");
  ASSERT_NE(overview, html.npos);
  EXPECT_LT(overview, html.find("<section class=\"experiment"));
  EXPECT_THAT(html, HasSubstr("<a href=\"#e2\">Three</a></th><td class=\"num\">2 of 3</td>"));
  EXPECT_THAT(html, HasSubstr("<section class=\"experiment fail\" id=\"e2\">"));
  EXPECT_THAT(html, HasSubstr("not met"));
}

TEST(Figures, wear_the_prefix_an_engineer_would_choose) {
  EXPECT_EQ(given(0.0335, "Nm/A"), "33.5\u00a0mNm/A");
  EXPECT_EQ(given(30e-6, "s"), "30\u00a0µs");
  EXPECT_EQ(given(7.3e-6, "Nm s"), "7.3·10⁻⁶\u00a0Nm s");
  EXPECT_EQ(given(0.0, "V"), "0\u00a0V");
  EXPECT_EQ(computed(1.0 / 30e-6, "Hz"), "33.33\u00a0kHz");
  EXPECT_EQ(computed(999.97, "A"), "1.000\u00a0kA");
  EXPECT_EQ(given(280, "deg"), "280°");
  EXPECT_EQ(plain(std::numeric_limits<double>::quiet_NaN(), 4), "–");
}

TEST(Figures, measured_and_required_share_a_unit_and_can_be_told_apart) {
  const Judged time = judged(0.000927, std::nullopt, 1e-3, "s");
  EXPECT_EQ(time.measured, "0.927\u00a0ms");
  EXPECT_EQ(time.required, "≤\u00a01\u00a0ms");
  const double exact = 24.0 / 1.03;
  const Judged current = judged(exact, exact * (1 - 1e-6), exact * (1 + 1e-6), "A");
  EXPECT_EQ(current.required, "23.300948 … 23.300994\u00a0A");
  EXPECT_EQ(current.measured, "23.300971\u00a0A");
}

TEST(Figures, deviation_is_signed_and_absolute_where_the_reference_is_zero) {
  EXPECT_EQ(deviation(1.02, 1.0, "A"), "+2.00\u00a0%");
  EXPECT_EQ(deviation(0.98, 1.0, "A"), "−2.00\u00a0%");
  EXPECT_EQ(deviation(0.02, 0.0, "A"), "+20.00\u00a0mA");
}

/// Values of similar size side by side have one unit prefix, so that their digits can be compared. A value
/// of more than ten times the reference is printed as a factor.
TEST(Figures, side_by_side_have_one_prefix) {
  const auto texts = computed_alike({0.03983, 0.07235, 0.1426, std::nullopt, 0.0}, "Nm");
  EXPECT_THAT(texts, ::testing::ElementsAre("39.83\u00a0mNm", "72.35\u00a0mNm", "142.6\u00a0mNm", "",
                                            "0.000\u00a0mNm"));
  EXPECT_THAT(computed_alike({2e-7, 1e-6}, "s"), ::testing::ElementsAre("0.2000\u00a0µs", "1.000\u00a0µs"));
  EXPECT_THAT(computed_alike({1e-6, 2.0}, "s"), ::testing::ElementsAre("1.000\u00a0µs", "2.000\u00a0s"));
  EXPECT_EQ(deviation(15.6, 1.0, "A"), "×\u00a015.6");
  EXPECT_EQ(deviation(1.0, 1e-9, "A"), "+1.000\u00a0A");
}

TEST(Figures, a_time_that_never_came_is_a_word) {
  const double ever = std::numeric_limits<double>::infinity();
  EXPECT_EQ(judged(ever, std::nullopt, 5e-3, "s").measured, "never");
  EXPECT_EQ(computed(ever, "s"), "never");
  EXPECT_EQ(computed(ever, "A"), "∞\u00a0A");
  EXPECT_EQ(deviation(ever, 5e-3, "s"), "not comparable");
  EXPECT_EQ(deviation(std::numeric_limits<double>::quiet_NaN(), 0.0, "A"), "not comparable");
}

TEST(Html, base64_is_the_standard_one_and_little_endian) {
  const float one = 1.0f;
  EXPECT_EQ(base64(std::span<const float>(&one, 1)), "AACAPw==");
  EXPECT_EQ((decoded<std::uint32_t, float>("AACAPw==")), std::vector<float>{1.0f});
}

TEST(Html, formulas_are_typeset_and_words_left_alone) {
  EXPECT_EQ(typeset("w0 sqrt(1 - xi^2), the pair is Re s +- j Im s"),
            "ω<sub>0</sub> √(1 − ξ²), the pair is Re s ± j Im s");
  EXPECT_EQ(typeset("-xi w0"), "−ξ ω<sub>0</sub>");
  EXPECT_EQ(typeset("plant with zero-order hold b0/(z + a0)"),
            "plant with zero-order hold b<sub>0</sub>/(z + a<sub>0</sub>)");
}

TEST(Report, leaves_out_what_is_zero_throughout) {
  SyntheticRun run = synthetic_run(0.001);
  std::ranges::fill(run.trace.values[10], 0.0);
  const nlohmann::json data = data_of(page(run));
  ASSERT_FALSE(data["charts"].empty());
  for (const auto& chart : data["charts"]) EXPECT_NE(chart["id"], "speed");
}

TEST(Html, underscores_become_subscripts) {
  EXPECT_EQ(with_subscripts("exp(s T_s) < K_reg"), "exp(s T<sub>s</sub>) &lt; K<sub>reg</sub>");
  EXPECT_EQ(with_subscripts("_x a_ ω_0"), "_x a_ ω<sub>0</sub>");
  EXPECT_EQ(with_subscripts("torque_constant_mNm_A, x_ohm_m"), "torque_constant_mNm_A, x_ohm_m") << "keys";
  EXPECT_EQ(with_subscripts("resistance_ohm"), "resistance_ohm");
}

}  // namespace SIXSTEP_TEST_FILE
