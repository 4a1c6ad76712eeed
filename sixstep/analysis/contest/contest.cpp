// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/contest/contest.hpp"

#include <cmath>
#include <iterator>
#include <limits>
#include <span>
#include <utility>

namespace sixstep::analysis {
namespace {

constexpr std::size_t gauges = std::size(contest_gauges);

/// The gauges stand behind the requirements; a run that could not start has none.
std::vector<double> values_of(const RunRecord& record) {
  if (record.end == RunEnd::refused || record.figures.size() < gauges)
    return std::vector<double>(std::size(contest_figures), std::numeric_limits<double>::quiet_NaN());
  return contest_values_of(std::span(record.figures).last(gauges));
}

/// Not a number is worst: a drive that has no figure did not get so far.
double worse(double a, double b) { return std::isnan(a) || a > b ? a : b; }

}  // namespace

Plan contest_plan(const std::vector<ContestEntry>& entries, std::size_t drives, std::uint64_t seed) {
  Axis axis;
  axis.key = "controller";
  for (const ContestEntry& entry : entries) axis.values.emplace_back(entry.who->name);
  Plan plan;
  plan.axes = {axis};
  plan.drives = drives;
  plan.seed = seed;
  return plan;
}

PlanColumns contest_columns(const Plan& plan, const ContestBench& bench) {
  return columns_of(plan, bench.scenario);
}

void take_nominal(ContestRow& row, RunRecord record, const PlanColumns& columns) {
  row.nominal = std::move(record);
  row.values = values_of(row.nominal);
  row.nominal_held = passed(row.nominal, columns);
}

void take_drive(Contest& contest, const RunRecord& record, const PlanColumns& columns) {
  if (contest.drives == 0 || record.number / contest.drives >= contest.rows.size()) return;
  ContestRow& row = contest.rows[record.number / contest.drives];
  if (row.worst.empty()) row.worst = row.values;
  const std::vector<double> values = values_of(record);
  for (std::size_t n = 0; n < values.size(); ++n) row.worst[n] = worse(values[n], row.worst[n]);
  ++row.drives;
  if (passed(record, columns)) ++row.held;
}

}  // namespace sixstep::analysis
