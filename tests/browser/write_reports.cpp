// SPDX-License-Identifier: Apache-2.0
// write_reports FOLDER: writes the pages that the browser tests open.
#include <filesystem>
#include <fstream>
#include <iostream>

#include "report/comparison.hpp"
#include "report/curve_page.hpp"
#include "report/plan_page.hpp"
#include "report/report.hpp"
#include "report/wiring_page.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "tests/report/synthetic_plan.hpp"
#include "tests/report/synthetic_run.hpp"
#include "tests/support/bench.hpp"
#include "tests/support/wirings.hpp"

namespace {

const char* scenario_text =
    R"(title = "Current PI, square wave 5 A at 100 Hz"   # <script>alert("not run")</script>
motor = "maxon-251601"
duration_s = 0.02
[control]
mode = "current"
)";

void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
  std::cout << file.string() << ": " << text.size() / 1024 << " KiB\n";
}

std::string page(const sixstep_tests::SyntheticRun& run) {
  return report::render({.scenario = run.scenario,
                         .outcome = run.outcome,
                         .trace = run.trace,
                         .command = "sixstep run data/scenarios/thesis/7.3.1.toml --html pi.html",
                         .version = "0.1.0",
                         .scenario_text = scenario_text});
}

/// A grid of a synthetic run. Such a run has no polynomials, so the value at an instant is the last row at or
/// before the instant.
sixstep::study::Trace sampled(const sixstep::study::Trace& trace) {
  sixstep::study::Trace grid{.columns = trace.columns, .values = {}, .every_event = false};
  grid.values.resize(trace.values.size());
  std::size_t row = 0;
  for (int n = 0; n <= 666; ++n) {
    const double t = n * 30e-6;
    while (row + 1 < trace.values[0].size() && trace.values[0][row + 1] <= t) ++row;
    for (std::size_t c = 0; c < grid.values.size(); ++c)
      grid.values[c].push_back(c == 0 ? t : trace.values[c][row]);
  }
  return grid;
}

std::string curve() {
  using namespace sixstep;
  const analysis::CurveRequest request{
      .sheet = testing::curve_sheet(), .bench = testing::maxon_bench(), .points = 21};
  const analysis::CurvePlan plan = *analysis::plan_curve(request);
  std::vector<analysis::OperatingPoint> found;
  for (const double speed : plan.speeds_rad_s)
    found.push_back(*analysis::operating_point(request.bench, speed));
  return report::render_curve({request,
                               *analysis::curve_of(request, plan, found, analysis::one_after_the_other),
                               "sixstep curve maxon-251601 --html curve.html", "0.1.0"});
}

std::string plan(const std::vector<sixstep_tests::SyntheticPlan>& made) {
  std::vector<text::PlanStory> stories;
  for (const sixstep_tests::SyntheticPlan& one : made) stories.push_back(one.story());
  report::PlanPageInput input{
      .plans = {}, .command = "sixstep run plan.toml --html plan.html", .version = "0.1.0"};
  for (const text::PlanStory& story : stories)
    input.plans.push_back({story,
                           "How quick may the speed loop be?",
                           "maxon-251601",
                           "What it answers.",
                           "sixstep run plan.toml --only",
                           {}});
  return report::render_plan(input);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  const auto good = sixstep_tests::synthetic_run(0.02);
  write(folder / "short.html", page(good));
  auto bad = sixstep_tests::synthetic_run(0.6);
  bad.scenario.title = "A longer run that misses its goal";
  bad.outcome.verdicts[0] = {"settling time of current", "s", 0.00131, std::nullopt, 1e-3, false};
  bad.scenario.control.mode = sixstep::control::Mode::speed;
  write(folder / "long.html", page(bad));
  write(folder / "curve.html", curve());
  const auto wirings = sixstep::testing::made_up_wirings();
  write(folder / "wirings.html",
        report::render_wiring(
            {wirings, scenario_text, "sixstep motor wiring maxon-251601 --html wirings.html", "0.1.0"}));
  using sixstep::analysis::Sampling;
  auto alone = sixstep_tests::synthetic_plan(sixstep_tests::grid_plan());
  write(folder / "plan.html", plan({alone}));
  auto later = sixstep_tests::synthetic_plan(sixstep_tests::drawn_plan(300, Sampling::latin_hypercube), 5e-4);
  later.name = "later";
  write(folder / "plans.html", plan({alone, later}));
  write(folder / "plan-indices.html",
        plan({sixstep_tests::synthetic_plan(sixstep_tests::drawn_plan(200, Sampling::saltelli))}));
  auto many = sixstep_tests::drawn_plan(12500, Sampling::sobol);
  many.drives = 8;
  write(folder / "plan-many.html", plan({sixstep_tests::synthetic_plan(many)}));
  const auto other = sixstep_tests::synthetic_run(0.02, 40.0);
  write(folder / "compare.html",
        report::render_comparison(
            {.runs = {{"as-is", good.scenario, &good.outcome, good.trace, sampled(good.trace)},
                      {"slower-start", other.scenario, &other.outcome, other.trace, sampled(other.trace)}},
             .command = "sixstep run as-is.toml slower-start.toml --html compare.html",
             .version = "0.1.0"}));
  write(folder / "index.html", report::render_index({{good.scenario.title, "short.html", &good.outcome},
                                                     {bad.scenario.title, "long.html", &bad.outcome}},
                                                    "sixstep run a.toml b.toml --out out", "0.1.0"));
}
