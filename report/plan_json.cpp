// SPDX-License-Identifier: Apache-2.0
#include "report/plan_json.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "report/chart_json.hpp"
#include "report/figures.hpp"
#include "report/plan_rows.hpp"
#include "text/escape/escape.hpp"

namespace report {
namespace {

namespace analysis = sixstep::analysis;
using Kind = PlanColumn::Kind;

const char* kind_of(const PlanColumn& column) {
  if (column.kind == Kind::figure) return "figure";
  if (column.kind == Kind::strayed) return "strayed";
  return column.words.empty() ? "key" : "word";
}

double largest(const std::vector<float>& values) {
  float most = 0;
  for (const float v : values)
    if (std::isfinite(v)) most = std::max(most, std::abs(v));
  return most;
}

json or_null(const std::optional<double>& x) { return x ? json(*x) : json(nullptr); }

json column_json(const PlanColumn& column) {
  const Scale scale = scale_for(largest(column.values), column.unit);
  json out{{"kind", kind_of(column)}, {"name", column.name}, {"unit", scale.unit}, {"factor", scale.factor}};
  if (column.logarithmic) out["log"] = true;
  if (!column.words.empty()) out["words"] = column.words;
  if (column.required) {
    out["required"] = true;
    out["min"] = or_null(column.min);
    out["max"] = or_null(column.max);
  }
  out["data"] = base64(std::span<const float>(column.values));
  return out;
}

json plan_json(const PagePlan& plan, std::size_t most) {
  const PlanRows rows = plan_rows(plan.story, most);
  json out{{"name", plan.story.name},
           {"repeats", plan.repeats},
           {"grid", plan.story.plan.sampling == analysis::Sampling::grid}};
  out["states"] = base64(std::span<const std::uint8_t>(rows.states));
  // Whether the run numbers are multiples of `every`. Then they need no column.
  bool counts = true;
  for (std::size_t n = 0; n < rows.numbers.size(); ++n)
    counts = counts && rows.numbers[n] == static_cast<double>(n * rows.every);
  if (counts)
    out["every"] = rows.every;
  else
    out["numbers"] = base64(std::span<const double>(rows.numbers));
  out["columns"] = json::array();
  for (const PlanColumn& column : rows.columns) out["columns"].push_back(column_json(column));
  out["reports"] = json::object();
  for (const auto& [number, file] : plan.reports)
    out["reports"][std::to_string(number)] = text::url_of_name(file);
  return out;
}

}  // namespace

std::string plan_data(const std::vector<PagePlan>& plans) {
  json page{{"plans", json::array()}};
  for (const PagePlan& plan : plans)
    page["plans"].push_back(plan_json(plan, most_rows_on_a_page / plans.size()));
  return dumped(page);
}

}  // namespace report
