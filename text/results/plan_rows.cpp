// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "sixstep/analysis/plan/plan_description.hpp"
#include "sixstep/base/written.hpp"
#include "text/escape/csv_cell.hpp"
#include "text/escape/json_number.hpp"
#include "text/escape/json_text.hpp"
#include "text/keys/decimal_number.hpp"
#include "text/results/plan_columns.hpp"
#include "text/results/plan_text.hpp"
#include "text/results/quantity_text.hpp"

namespace text {
namespace {

using Json = nlohmann::ordered_json;

Json stored_or_null(const std::optional<double>& x) { return x ? figure_json(*x) : Json(nullptr); }

Json columns_json(const PlanStory& s) {
  Json keys = Json::array(), strayed = Json::array(), figures = Json::array();
  for (const analysis::InputColumn& c : s.columns.keys) keys.push_back({{"key", c.key}, {"unit", c.unit}});
  for (const analysis::InputColumn& c : s.columns.strayed)
    strayed.push_back({{"key", c.key}, {"unit", c.unit}});
  for (const analysis::SpreadFigure& f : s.series.figures) {
    Json figure = {{"figure", f.column.name},
                   {"unit", f.column.unit},
                   {"required", f.column.required},
                   {"min", stored_or_null(f.column.min)},
                   {"max", stored_or_null(f.column.max)}};
    if (f.column.required) figure["holds"] = f.holds;
    const analysis::Statistics& t = f.statistics;
    figure["statistics"] = {{"count", t.count()},
                            {"least", stored_or_null(t.min())},
                            {"p5", stored_or_null(t.quantile(0.05))},
                            {"median", stored_or_null(t.median())},
                            {"p95", stored_or_null(t.quantile(0.95))},
                            {"greatest", stored_or_null(t.max())},
                            {"mean", stored_or_null(t.mean())},
                            {"deviation", stored_or_null(t.standard_deviation())}};
    figures.push_back(std::move(figure));
  }
  return {{"keys", keys}, {"strayed", strayed}, {"figures", figures}};
}

Json interval(const analysis::Estimated& e) { return {{"value", e.value}, {"low", e.low}, {"high", e.high}}; }

/// The sensitivity indices: a list per figure, with an entry per key; null for a figure without indices.
Json indices_json(const PlanStory& s) {
  Json all = Json::array();
  for (std::size_t f = 0; f < s.columns.figures.size(); ++f) {
    const auto found = indices_of(s, f);
    Json of_figure = found ? Json::array() : Json(nullptr);
    for (std::size_t k = 0; found && k < found->size(); ++k)
      of_figure.push_back({{"first", interval((*found)[k].first)}, {"total", interval((*found)[k].total)}});
    all.push_back(std::move(of_figure));
  }
  return all;
}

/// A point's value as a number, a flag or a word.
Json value_json(const std::string& written) {
  const Json read = Json::parse(written, nullptr, false);
  return read.is_discarded() ? Json(analysis::bare(written)) : read;
}

/// Names of all cells of a row.
std::vector<std::string> row_names(const analysis::PlanColumns& columns) {
  std::vector<std::string> names(std::begin(columns_before), std::end(columns_before));
  for (std::string& name : column_names(columns)) names.push_back(std::move(name));
  names.insert(names.end(), std::begin(columns_behind), std::end(columns_behind));
  return names;
}

Json row_json(const analysis::RunRecord& r) {
  Json row = {r->number, base::word(analysis::run_ends, r->end), analysis::passed(r)};
  for (const std::string& value : r->point) row.push_back(value_json(value));
  for (const double x : r->strayed) row.push_back(figure_json(x));
  for (const double x : r->figures) row.push_back(figure_json(x));
  row.push_back(r->problem);
  row.push_back(base::written_hex(r->digest));
  return row;
}

/// The cell of a value: a number as written, a word escaped like a name.
std::string value_cell(const std::string& written) {
  return number_alone(written) ? written : csv_cell(analysis::bare(written));
}

}  // namespace

std::string plan_csv_head(const analysis::PlanColumns& columns) {
  std::vector<std::string> cells;
  for (const std::string& name : row_names(columns)) cells.push_back(csv_cell(name));
  return fmt::format("{}\n", fmt::join(cells, ","));
}

std::string plan_csv_row(const analysis::RunRecord& r) {
  std::string line =
      fmt::format("{},{},{}", r->number, base::word(analysis::run_ends, r->end), analysis::passed(r) ? 1 : 0);
  for (const std::string& value : r->point) line += "," + value_cell(value);
  for (const std::vector<double>* numbers : {&r->strayed, &r->figures})
    for (const double x : *numbers) line += "," + (std::isfinite(x) ? base::written(x) : csv_cell(x));
  return line + "," + csv_cell(r->problem) + "," + base::written_hex(r->digest) + "\n";
}

std::string plan_json(const PlanStory& s, const std::string& title, const std::string& motor) {
  Json json = {{"sixstep", SIXSTEP_VERSION}, {"title", title}, {"motor", motor}};
  json["plan"] = {{"sampling", base::word(analysis::sampling_choices, s.plan.sampling)},
                  {"points", analysis::points_of(s.plan)},
                  {"drives", s.plan.drives},
                  {"seed", s.plan.seed},
                  {"runs", analysis::runs_of(s.plan)}};
  json["complete"] = s.series.runs == analysis::runs_of(s.plan);
  json["runs"] = s.series.runs;
  json["passed"] = s.series.passed;
  json["faults"] = s.series.faults.size();
  json["refused"] = s.series.refused.size();
  json["remarks"] = Json::array();
  for (const analysis::SeriesRemark& r : s.series.remarks)
    json["remarks"].push_back({{"text", r.text}, {"runs", r.numbers}});
  json["digest"] = base::written_hex(s.series.digest);
  json.update(columns_json(s));
  if (s.plan.sampling == analysis::Sampling::saltelli) json["indices"] = indices_json(s);
  json["columns"] = row_names(s.columns);
  // One row per line, because programs may read a hundred thousand rows line by line.
  std::string text = json_text(json);
  text.resize(text.find_last_of('}'));
  text.erase(text.find_last_not_of(" \n") + 1);
  text += ",\n  \"rows\": [";
  bool first = true;
  s.each([&](const analysis::RunRecord& record) {
    text += (first ? "\n    " : ",\n    ") + json_text(row_json(record), -1);
    first = false;
  });
  return text + "\n  ]\n}\n";
}

}  // namespace text
