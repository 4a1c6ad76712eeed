// SPDX-License-Identifier: Apache-2.0
// The page of a plan draws the values of the rows, lists the runs with the smallest margins, and escapes all
// names. The same plan gives the same bytes.
#include "report/plan_page.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

#include "report/plan_rows.hpp"
#include "report/plan_worst.hpp"
#include "tests/report/synthetic_plan.hpp"
#include "text/keys/decimal_number.hpp"
#include "text/results/quantity_text.hpp"

namespace report {
namespace SIXSTEP_TEST_FILE {

using nlohmann::json;
using sixstep::analysis::Sampling;
using sixstep_tests::drawn_plan;
using sixstep_tests::grid_plan;
using sixstep_tests::synthetic_plan;
using sixstep_tests::SyntheticPlan;
using ::testing::HasSubstr;
using ::testing::Not;

std::string page_of(const SyntheticPlan& made, std::map<std::size_t, std::string> reports = {}) {
  const text::PlanStory story = made.story();
  return render_plan(
      {.plans = {{story, "Made up", "a motor", "what for", "sixstep run a.toml --only", std::move(reports)}},
       .command = "sixstep run a.toml",
       .version = "0"});
}

json data_of(const std::string& page) {
  const std::string open = "<script type=\"application/json\" id=\"data\">";
  const std::size_t from = page.find(open) + open.size();
  return json::parse(page.substr(from, page.find("</script>", from) - from));
}

std::string bytes_of(const std::string& text) {
  static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0, count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<unsigned>(digits.find(c));
    if ((count += 6) >= 8) bytes += static_cast<char>(bits >> (count -= 8) & 0xffu);
  }
  return bytes;
}

std::vector<float> floats_of(const std::string& text) {
  const std::string bytes = bytes_of(text);
  std::vector<float> values;
  for (std::size_t n = 0; n + 3 < bytes.size(); n += 4) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 4; ++k)
      word |= std::uint32_t{static_cast<unsigned char>(bytes[n + k])} << (8 * k);
    values.push_back(std::bit_cast<float>(word));
  }
  return values;
}

bool same(float a, double b) { return std::isnan(a) ? std::isnan(b) : a == static_cast<float>(b); }

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(PlanPage, DrawsFromWhatTheRowsSay) {
  const SyntheticPlan made = synthetic_plan(grid_plan());
  const json plan = data_of(page_of(made))["plans"][0];
  EXPECT_EQ(plan["every"], 1);
  EXPECT_EQ(plan["columns"].size(), 6u);
  const std::string states = bytes_of(plan["states"]);
  ASSERT_EQ(states.size(), made.rows.size());
  std::vector<std::vector<float>> columns;
  for (const json& column : plan["columns"]) columns.push_back(floats_of(column["data"]));
  const json words = plan["columns"][2]["words"];
  for (std::size_t n = 0; n < made.rows.size(); ++n) {
    const auto& row = made.rows[n];
    EXPECT_EQ(states[n] == 0, passed(row));
    EXPECT_TRUE(same(columns[0][n], std::stod(row->point[0])));
    EXPECT_EQ("\"" + words[static_cast<std::size_t>(columns[2][n])].get<std::string>() + "\"", row->point[2]);
    for (std::size_t f = 0; f < 3; ++f) EXPECT_TRUE(same(columns[3 + f][n], row->figures[f])) << n;
  }
  EXPECT_EQ(plan["columns"][3]["unit"], "ms") << "as one reads it";
  EXPECT_EQ(plan["columns"][3]["max"], 6e-3);
  EXPECT_TRUE(plan["columns"][3]["min"].is_null());
}

TEST(PlanPage, SaysWhichRunsAreMissing) {
  SyntheticPlan made = synthetic_plan(grid_plan());
  made.rows.erase(made.rows.begin() + 3);
  made.sum_up();
  const std::string page = page_of(made);
  EXPECT_THAT(page, HasSubstr("Interrupted: this page has 125 of 126 runs."));
  EXPECT_TRUE(data_of(page)["plans"][0].contains("numbers"));
}

TEST(PlanPage, LeavesOutRunsEvenlyWhereThereAreTooMany) {
  const SyntheticPlan made = synthetic_plan(drawn_plan(1000, Sampling::sobol));
  for (const std::size_t most : {1u, 7u, 333u, 999u, 1000u, 5000u}) {
    const PlanRows rows = plan_rows(made.story(), most);
    EXPECT_LE(rows.numbers.size(), most);
    EXPECT_GE(2 * rows.numbers.size(), std::min<std::size_t>(most, 1000));
    for (std::size_t n = 0; n < rows.numbers.size(); ++n)
      EXPECT_EQ(rows.numbers[n], static_cast<double>(n * rows.every));
  }
}

TEST(PlanPage, EveryRunIsInAHistogramOnce) {
  const SyntheticPlan made = synthetic_plan(drawn_plan(3000, Sampling::monte_carlo));
  const std::vector<Span> spans = figure_spans(made.story());
  const std::vector<Histogram> all = histograms(made.story(), spans);
  for (std::size_t f = 0; f < all.size(); ++f) {
    std::size_t sum = all[f].never + all[f].missing;
    for (const std::size_t n : all[f].counts) sum += n;
    EXPECT_EQ(sum, 3000u);
    EXPECT_GT(all[f].counts.front(), 0u) << "the least";
    EXPECT_GT(all[f].counts.back(), 0u) << "the greatest";
  }
  EXPECT_GT(all[0].never, 0u);
  EXPECT_GT(all[1].missing, 0u);
}

TEST(PlanPage, TheWorstRunsAreTheWorst) {
  const SyntheticPlan made = synthetic_plan(drawn_plan(2000, Sampling::latin_hypercube));
  const auto worst = worst_of(made.story(), 20);
  ASSERT_EQ(worst.size(), 3u);
  EXPECT_TRUE(worst[2].empty()) << "it has no requirements";
  for (std::size_t f = 0; f < 2; ++f) {
    // The worst runs are the first runs after a sort by margin.
    const auto& column = made.columns->figures[f];
    std::vector<std::pair<double, std::size_t>> sorted;
    for (const auto& row : made.rows) {
      if (row->end == sixstep::analysis::RunEnd::refused) continue;
      const double x = row->figures[f];
      sorted.emplace_back(
          std::min(column.min ? x - *column.min : INFINITY, column.max ? *column.max - x : INFINITY),
          row->number);
    }
    std::sort(sorted.begin(), sorted.end());
    ASSERT_EQ(worst[f].size(), 20u);
    for (std::size_t n = 0; n < 20; ++n) EXPECT_EQ(worst[f][n].number, sorted[n].second) << f << " " << n;
  }
  const auto first = worst_runs(made.story(), 3);
  EXPECT_EQ(first,
            (std::vector<std::size_t>{worst[0][0].number, worst[1][0].number, made.series.faults[0].number}));
}

TEST(PlanPage, HasEveryPart) {
  const SyntheticPlan made = synthetic_plan(grid_plan());
  const std::size_t run = worst_runs(made.story(), 1)[0];
  const std::string page = page_of(made, {{run, "made-up.run.html"}});
  EXPECT_EQ(page, page_of(made, {{run, "made-up.run.html"}})) << "the same bytes";
  EXPECT_THAT(page, Not(HasSubstr("{{")));
  EXPECT_THAT(page.substr(0, page.find("<script")), Not(HasSubstr("nan")));
  EXPECT_THAT(page, Not(HasSubstr("Charts: uPlot"))) << "drawn without it";
  EXPECT_EQ(count(page, "<figure class=\"chart drawn histogram\">"), 3u);
  EXPECT_THAT(page, HasSubstr("sixstep run a.toml --only " + std::to_string(run) + " --html run-"));
  EXPECT_THAT(page, HasSubstr("<a href=\"made-up.run.html\">run\u00a0" + std::to_string(run) + "</a>"));
  EXPECT_THAT(page, HasSubstr("what for"));
  EXPECT_THAT(page, HasSubstr("soft, hard"));
  EXPECT_THAT(page, Not(HasSubstr("class=\"indices\"")));
}

TEST(PlanPage, HasIndicesWhereThePlanIsLaidOutForThem) {
  const std::string page = page_of(synthetic_plan(drawn_plan(64, Sampling::saltelli)));
  EXPECT_EQ(count(page, "<table class=\"indices\">"), 3u);
}

TEST(PlanPage, OfTwoPlansEachFigureIsDrawnOnce) {
  const SyntheticPlan one = synthetic_plan(grid_plan()),
                      other = synthetic_plan(drawn_plan(100, Sampling::sobol), 1e-3);
  const text::PlanStory a = one.story(), b = other.story();
  const std::string page = render_plan({.plans = {{a, "A", "m", "", "sixstep run a.toml --only"},
                                                  {b, "B", "m", "", "sixstep run b.toml --only"}},
                                        .command = "c",
                                        .version = "0"});
  EXPECT_EQ(count(page, "<figure class=\"chart drawn histogram\">"), 3u);
  EXPECT_EQ(count(page, "style=\"fill: var(--a)\""), 3u);
  EXPECT_EQ(count(page, "style=\"fill: var(--c)\""), 3u);
  EXPECT_EQ(data_of(page)["plans"].size(), 2u);
}

TEST(PlanPage, HoldsNamesAsText) {
  const std::string bad = "</script><script>alert(1)</script>&'\"";
  SyntheticPlan made = synthetic_plan(grid_plan());
  sixstep::analysis::PlanColumns columns = *made.columns;
  made.name = columns.keys[2].key = columns.figures[0].name = columns.figures[1].unit = bad;
  made.plan.axes[2].values = {"\"" + bad + "\"", "\"b\""};
  made.rename(std::move(columns), bad);
  const text::PlanStory story = made.story();
  const std::string page =
      render_plan({.plans = {{story, bad, bad, bad, "sixstep run " + bad, {{worst_runs(story, 1)[0], bad}}}},
                   .command = bad,
                   .version = bad});
  EXPECT_EQ(count(page, "<script"), 2u) << "the data and the page's own";
  EXPECT_THAT(page, Not(HasSubstr("alert(1)</script>")));
  EXPECT_EQ(data_of(page)["plans"][0]["columns"][3]["name"], bad);
}

/// The values on the card are equal to the values in the terminal. Only two characters differ: the terminal
/// prints u for µ, and a space at which a line may break.
TEST(PlanPage, values_of_an_axis_are_told_as_the_terminal_tells_them) {
  const std::vector<std::string> written{"2e-07", "1e-06", "0.0035", "12", "\"ideal\""};
  SyntheticPlan made =
      synthetic_plan({.axes = {{.key = "control.speed.settle_s", .values = {"0.002", "0.004"}},
                               {.key = "supply.voltage_V", .values = {"12", "24"}}}});
  made.plan.axes[0].values = written;
  std::string words;
  for (const std::string& value : written) {
    const auto number = text::number_alone(value);
    std::string one = number ? text::quantity_text(*number, "s", 4) : "ideal";
    if (const auto at = one.find(" u"); at != one.npos) one.replace(at, 2, " µ");
    if (const auto at = one.find(' '); at != one.npos) one.replace(at, 1, "\u00a0");
    words += (words.empty() ? "" : ", ") + one;
  }
  EXPECT_THAT(words, HasSubstr("200\u00a0ns, 1\u00a0µs"));
  EXPECT_THAT(page_of(made), HasSubstr("<dt>control.speed.settle_s</dt><dd>" + words + "</dd>"));
}

}  // namespace SIXSTEP_TEST_FILE
}  // namespace report
