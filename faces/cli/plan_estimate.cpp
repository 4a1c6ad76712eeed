// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/plan_estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "batch/plan_runs.hpp"
#include "faces/cli/plan_ranks.hpp"
#include "faces/cli/stop_signals.hpp"
#include "faces/cli/terminal.hpp"
#include "text/escape/escape.hpp"
#include "text/results/quantity_text.hpp"

namespace cli {
namespace {

using std::chrono::duration;
using std::chrono::steady_clock;

/// Bytes of a row in the store: number, words, digest and checksum of the run. Each column adds eight bytes
/// for its value and SQLite's overhead.
constexpr double row_bytes = 79, column_bytes = 9;

std::string time_text(double s) {
  if (s < 120) return text::quantity_text(s, "s", 2);
  if (s < 7200) return fmt::format("{:.0f} min", s / 60);
  if (s < 48 * 3600) return fmt::format("{:.1f} h", s / 3600);
  return fmt::format("{:.1f} days", s / 86400);
}

std::string size_text(double bytes) {
  if (bytes < 1e6) return fmt::format("{:.0f} kB", std::max(1.0, bytes / 1e3));
  return bytes < 1e9 ? fmt::format("{:.1f} MB", bytes / 1e6) : fmt::format("{:.1f} GB", bytes / 1e9);
}

std::string axis_text(const analysis::Axis& axis, const std::string& unit, bool grid) {
  if (!axis.values.empty()) return fmt::format("{}: {}", axis.key, fmt::join(axis.values, ", "));
  const std::string ends = text::quantity_text(axis.from, unit) + " .. " + text::quantity_text(axis.to, unit);
  const std::string spaced = axis.spacing == analysis::Spacing::logarithmic ? ", equal factors" : "";
  return grid ? fmt::format("{}: {} values {}{}", axis.key, axis.points, ends, spaced)
              : fmt::format("{}: {}{}", axis.key, ends, spaced);
}

/// A few runs at points spread over the plan; together they take about a second.
struct Sample {
  std::size_t runs = 0;
  double each_s = 0.0;
  std::string refused;  ///< problem of the first run that could not start
};

Sample sample_of(const batch::PlanRuns& runs) {
  const std::size_t all = analysis::runs_of(runs.plan);
  const auto begin = steady_clock::now();
  Sample sample;
  double spent_s = 0.0;
  for (std::size_t k = 0; k < std::min<std::size_t>(all, 16) && spent_s < 2.0 && !interrupted(); ++k) {
    // Multiples of the golden section are spread evenly for any number of runs.
    const auto n =
        static_cast<std::size_t>(static_cast<double>(k) * 0.6180339887498949 * static_cast<double>(all)) %
        all;
    const std::optional<analysis::RunRecord> record = batch::run_one(runs, n);
    if (record && (*record)->end == analysis::RunEnd::refused && sample.refused.empty())
      sample.refused = fmt::format("run {}: {}", n, (*record)->problem);
    spent_s = duration<double>(steady_clock::now() - begin).count();
    ++sample.runs;
  }
  if (sample.runs > 0) sample.each_s = spent_s / static_cast<double>(sample.runs);
  return sample;
}

}  // namespace

Exit estimate(const RunArguments& arguments, const ReadPlan& plan) {
  const analysis::Plan& p = plan.scenarios->plan();
  const std::size_t all = analysis::runs_of(p);
  const Sample sample = sample_of({.plan = p,
                                   .columns = plan.columns,
                                   .scenario = [&](std::size_t n) { return plan.scenarios->run(n); },
                                   .wanted = {},
                                   .take = {},
                                   .stop = {},
                                   .jobs = 1});
  if (interrupted()) return told_interrupted("the estimate of " + text::visible(plan.name));
  const double cores = threads_for_runs(arguments.jobs);
  const double columns = static_cast<double>(plan.columns->keys.size() + plan.columns->strayed.size() +
                                             plan.columns->figures.size());
  std::string text = fmt::format("{}\n", text::visible(plan.name));
  for (std::size_t k = 0; k < p.axes.size(); ++k)
    text += "  " +
            text::visible(
                axis_text(p.axes[k], plan.columns->keys[k].unit, p.sampling == analysis::Sampling::grid)) +
            "\n";
  const std::size_t points = analysis::points_of(p);
  text += fmt::format("  {} point{}", points, points == 1 ? "" : "s");
  if (p.sampling == analysis::Sampling::saltelli) text += fmt::format(", {} x (keys + 2)", p.points);
  if (p.drives > 0) text += fmt::format(" of {} drives each", p.drives);
  text += fmt::format(": {} run{}\n  {} a run on one core ({} tried), about {} on {:.0f} cores\n", all,
                      all == 1 ? "" : "s", time_text(sample.each_s), sample.runs,
                      time_text(sample.each_s * static_cast<double>(all) / cores), cores);
  text += fmt::format("  a store of {}\n",
                      size_text(static_cast<double>(all) * (row_bytes + column_bytes * columns)));
  if (!sample.refused.empty())
    text += "  some runs cannot start, for example " + text::visible(sample.refused) + "\n";
  print(text);
  return Exit::ok;
}

}  // namespace cli
