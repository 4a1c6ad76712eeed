// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/contest/contest.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace sixstep::analysis {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

ContestValues values_of(const RunRecord& record) {
  return record->end == RunEnd::refused ? no_contest_values() : contest_values_of(gauges_of(record));
}

/// The worse of two figures. NaN is the worst value: the drive ended before the figure.
double worse(double a, double b) { return std::isnan(a) || a > b ? a : b; }

Plan plan_of(const std::vector<ContestEntry>& entries, std::size_t drives, std::uint64_t seed) {
  Axis axis;
  axis.key = "controller";
  for (const ContestEntry& entry : entries) axis.values.emplace_back(entry.who->name);
  Plan plan;
  plan.axes = {axis};
  plan.drives = drives;
  plan.seed = seed;
  return plan;
}

/// The scenario that determines the table's columns. The entries differ from the bench in their [[spread]],
/// but all entries have the same [[spread]].
const study::Scenario& with_columns(const ContestBench& bench, const std::vector<ContestEntry>& entries) {
  const auto first = std::find_if(entries.begin(), entries.end(), [](const ContestEntry& entry) {
    return static_cast<bool>(entry.scenario);
  });
  return first == entries.end() ? bench.scenario : *first->scenario;
}

}  // namespace

ContestValues no_contest_values() {
  ContestValues values{};
  values.fill(none);
  return values;
}

Contest contest_of(ContestBench bench, std::vector<ContestEntry> entries, std::size_t drives,
                   std::uint64_t seed, const UnitOfKey& unit_of) {
  Plan plan = plan_of(entries, drives, seed);
  TableColumns columns = columns_of(plan, with_columns(bench, entries), unit_of);
  std::vector<ContestRow> rows(entries.size());
  return {std::move(bench), std::move(entries), std::move(rows), std::move(plan), std::move(columns)};
}

double most_peak_A(const ContestBench& bench) {
  constexpr double with_commutations = 1.5;
  return with_commutations * bench.design.current_at_full_torque_A + bench.design.ripple.worst_A;
}

bool may_win(const Contest& contest, std::size_t row) {
  const ContestRow& r = contest.rows[row];
  return r.nominal_held && !(r.values[peak_figure] > most_peak_A(contest.bench));
}

GaugeValues gauges_of(const RunRecord& record) {
  GaugeValues gauges{};
  gauges.fill(none);
  const std::vector<FigureColumn>& columns = record.columns().figures;
  for (std::size_t g = 0; g < gauges.size(); ++g) {
    const auto column = std::find_if(columns.begin(), columns.end(), [g](const FigureColumn& c) {
      return !c.required && c.name == contest_gauges[g].label;
    });
    if (column != columns.end())
      gauges[g] = record->figures[static_cast<std::size_t>(column - columns.begin())];
  }
  return gauges;
}

void take_nominal(Contest& contest, std::size_t entry, const base::Result<study::Outcome>& result) {
  const base::Result<study::Scenario>& scenario = contest.entries[entry].scenario;
  const base::Result<PlannedRun> alone = scenario ? base::Result<PlannedRun>(PlannedRun{*scenario, {}})
                                                  : base::Result<PlannedRun>(scenario.problems());
  const TableColumns columns = columns_of({}, scenario ? *scenario : contest.bench.scenario);
  ContestRow& row = contest.rows[entry];
  row.nominal = record_of(columns, 0, {}, alone, result);
  row.values = values_of(*row.nominal);
  row.nominal_held = passed(*row.nominal);
}

void take_drive(Contest& contest, const RunRecord& record) {
  const std::size_t drives = contest.plan.drives;
  if (drives == 0 || record->number / drives >= contest.rows.size()) return;
  ContestRow& row = contest.rows[record->number / drives];
  if (!row.worst) row.worst = row.values;
  const ContestValues values = values_of(record);
  for (std::size_t n = 0; n < values.size(); ++n) (*row.worst)[n] = worse(values[n], (*row.worst)[n]);
  ++row.drives;
  if (passed(record)) ++row.held;
}

}  // namespace sixstep::analysis
