// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/plan/plan_table.hpp"

#include <limits>

#include "sixstep/study/measure/figures.hpp"

namespace sixstep::analysis {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

FigureColumn column_of(const study::Scenario& scenario, const study::Measure& measure) {
  const base::LinearUnit unit = study::unit_in(scenario, study::figure_unit(measure));
  return {
      .name = study::figure_name(scenario, measure), .unit = std::string(unit.linear), .min = {}, .max = {}};
}

FigureColumn column_of(const study::Scenario& scenario, const study::Requirement& r) {
  const double factor = study::unit_in(scenario, study::figure_unit(r.measure)).factor;
  FigureColumn column = column_of(scenario, r.measure);
  column.required = true;
  if (r.min) column.min = *r.min * factor;
  if (r.max) column.max = *r.max * factor;
  return column;
}

}  // namespace

PlanColumns columns_of(const Plan& plan, const study::Scenario& scenario) {
  PlanColumns columns;
  for (const Axis& axis : plan.axes) columns.keys.push_back(axis.key);
  if (plan.drives > 0)
    for (const study::Spread& spread : scenario.spread) columns.strayed.push_back(spread.key);
  for (const study::Requirement& r : scenario.require) columns.figures.push_back(column_of(scenario, r));
  for (const study::Comparison& c : scenario.compare)
    columns.figures.push_back(column_of(scenario, c.measure));
  return columns;
}

RunRecord record_of(const base::Result<study::Outcome>& result, const PlanColumns& columns) {
  RunRecord record;
  record.figures.reserve(columns.figures.size());
  if (!result) {
    record.end = RunEnd::refused;
    record.problem = base::to_string(result.problems().front());
    record.figures.assign(columns.figures.size(), none);
    return record;
  }
  for (const study::Verdict& v : result->verdicts) record.figures.push_back(v.measured);
  for (const study::ComparisonResult& c : result->comparisons) record.figures.push_back(c.measured);
  record.digest = result->digest;
  if (!result->fault) return record;
  record.end = RunEnd::fault;
  record.problem = base::to_string(*result->fault);
  return record;
}

bool passed(const RunRecord& record, const PlanColumns& columns) {
  if (record.end != RunEnd::whole) return false;
  for (std::size_t n = 0; n < columns.figures.size(); ++n)
    if (!columns.figures[n].holds(record.figures[n])) return false;
  return true;
}

}  // namespace sixstep::analysis
