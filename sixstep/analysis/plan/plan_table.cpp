// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/plan/plan_table.hpp"

#include <algorithm>
#include <limits>

#include "sixstep/study/measure/figures.hpp"
#include "sixstep/study/scenario/spread.hpp"

namespace sixstep::analysis {
namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

FigureColumn column_of(const study::Scenario& scenario, const study::Measure& measure) {
  const base::LinearUnit unit = study::unit_in(scenario, study::figure_unit(measure));
  return {.name = study::figure_name(scenario, measure),
          .unit = std::string(unit.linear),
          .min = {},
          .max = {},
          .zero = study::figure_zero(scenario, measure)};
}

FigureColumn column_of(const study::Scenario& scenario, const study::Requirement& r) {
  const double factor = study::unit_in(scenario, study::figure_unit(r.measure)).factor;
  FigureColumn column = column_of(scenario, r.measure);
  column.required = true;
  if (r.min) column.min = *r.min * factor;
  if (r.max) column.max = *r.max * factor;
  return column;
}

bool same_keys(const std::vector<Strayed>& strayed, const std::vector<InputColumn>& columns) {
  return std::equal(strayed.begin(), strayed.end(), columns.begin(), columns.end(),
                    [](const Strayed& s, const InputColumn& c) { return s.key == c.key; });
}

bool is_column_of(const FigureColumn& column, const study::Verdict& v) {
  return column.required && column.name == v.figure && column.unit == v.unit && column.min == v.min &&
         column.max == v.max;
}
bool is_column_of(const FigureColumn& column, const study::ComparisonResult& c) {
  return !column.required && column.name == c.figure && column.unit == c.unit;
}

/// The figures in the columns' order; empty if the run's figures differ from the columns.
std::optional<std::vector<double>> figures_of(const study::Outcome& outcome, const PlanColumns& columns) {
  std::vector<double> figures;
  figures.reserve(columns.figures.size());
  const auto take = [&](const auto& results) {
    for (const auto& result : results) {
      if (figures.size() == columns.figures.size() || !is_column_of(columns.figures[figures.size()], result))
        return false;
      figures.push_back(result.measured);
    }
    return true;
  };
  if (!take(outcome.verdicts) || !take(outcome.comparisons) || figures.size() != columns.figures.size())
    return {};
  return figures;
}

std::string so_many(std::size_t n, const char* what) { return std::to_string(n) + " " + what; }

}  // namespace

TableColumns columns_of(const Plan& plan, const study::Scenario& scenario, const UnitOfKey& unit_of) {
  PlanColumns columns;
  const auto input = [&](const std::string& key) {
    return InputColumn{key, unit_of ? unit_of(key) : std::string()};
  };
  for (const Axis& axis : plan.axes) columns.keys.push_back(input(axis.key));
  if (plan.drives > 0)
    for (const study::Spread& spread : scenario.spread) columns.strayed.push_back(input(spread.key));
  for (const study::Requirement& r : scenario.require) columns.figures.push_back(column_of(scenario, r));
  for (const study::Comparison& c : scenario.compare)
    columns.figures.push_back(column_of(scenario, c.measure));
  for (const study::LaidOver& laid : scenario.recordings())
    for (const std::string& word : laid.recording.asked())
      if (const std::optional<study::NamedFigure> figure = study::recorded_figure(word))
        columns.figures.push_back({.name = figure->name(laid.measure),
                                   .unit = std::string(figure->unit(laid.measure)),
                                   .min = {},
                                   .max = {}});
  return std::make_shared<const PlanColumns>(std::move(columns));
}

PlannedRun planned_drive(const study::Scenario& nominal, std::uint64_t seed, std::size_t drive) {
  PlannedRun run{study::varied(nominal, seed, drive), {}};
  const std::vector<double> values = study::strayed_values(nominal, run.scenario);
  for (std::size_t n = 0; n < nominal.spread.size(); ++n)
    run.strayed.push_back({nominal.spread[n].key, values[n]});
  return run;
}

base::Result<RunRecord> RunRecord::of(TableColumns columns, RunValues values) {
  const PlanColumns& c = *columns;
  if (values.point.size() == c.keys.size() && values.strayed.size() == c.strayed.size() &&
      values.figures.size() == c.figures.size())
    return RunRecord(std::move(columns), std::move(values));
  return base::Problem{
      "run " + std::to_string(values.number),
      so_many(values.point.size(), "varied, ") + so_many(values.strayed.size(), "strayed and ") +
          so_many(values.figures.size(), "measured values"),
      "do not fit the table, which has " + so_many(c.keys.size(), "varied, ") +
          so_many(c.strayed.size(), "strayed and ") + so_many(c.figures.size(), "measured columns"),
      "this is a defect of sixstep: report this message, with the command, in the issues of the repository"};
}

RunRecord RunRecord::without_figures(TableColumns columns, std::size_t number, std::vector<std::string> point,
                                     RunEnd end, std::string problem) {
  RunValues values;
  values.number = number;
  values.point = std::move(point);
  values.point.resize(columns->keys.size());
  values.strayed.assign(columns->strayed.size(), no_value);
  values.figures.assign(columns->figures.size(), no_value);
  values.end = end;
  values.problem = std::move(problem);
  return RunRecord(std::move(columns), std::move(values));
}

RunRecord record_of(const TableColumns& columns, std::size_t number, std::vector<std::string> point,
                    const base::Result<PlannedRun>& planned, const base::Result<study::Outcome>& result) {
  RunRecord nothing = RunRecord::without_figures(columns, number, std::move(point), RunEnd::refused, {});
  RunValues values = *nothing;
  const auto without_figures = [&](const std::string& problem) {
    values.problem = problem;
    return RunRecord::of(columns, values);
  };
  if (planned && same_keys(planned->strayed, columns->strayed))
    for (std::size_t n = 0; n < values.strayed.size(); ++n) values.strayed[n] = planned->strayed[n].value;
  else if (planned)
    return *without_figures("this run draws random values of other keys than the table's other runs");
  if (!result) return *without_figures(base::to_string(result.problems().front()));
  std::optional<std::vector<double>> figures = figures_of(*result, *columns);
  if (!figures)
    return *without_figures("the figures of this run, or their units, differ from the table's other runs");
  values.end = result->fault ? RunEnd::fault : RunEnd::whole;
  if (result->fault) values.problem = base::to_string(*result->fault);
  values.remarks = result->remarks;
  values.figures = std::move(*figures);
  values.digest = result->digest;
  return *RunRecord::of(columns, std::move(values));
}

bool passed(const RunRecord& record) {
  if (record->end != RunEnd::whole) return false;
  const std::vector<FigureColumn>& columns = record.columns().figures;
  for (std::size_t n = 0; n < columns.size(); ++n)
    if (!columns[n].holds(record->figures[n])) return false;
  return true;
}

}  // namespace sixstep::analysis
