// SPDX-License-Identifier: Apache-2.0
#include "report/plan_rows.hpp"

#include <algorithm>
#include <cmath>

#include "text/keys/decimal_number.hpp"

namespace report {
namespace {

namespace analysis = sixstep::analysis;
constexpr float no_value = std::numeric_limits<float>::quiet_NaN();

bool has_words(const analysis::Axis& axis) {
  return std::any_of(axis.values.begin(), axis.values.end(),
                     [](const std::string& v) { return !text::number_alone(v); });
}

std::vector<PlanColumn> columns_of(const text::PlanStory& story) {
  std::vector<PlanColumn> columns;
  const analysis::PlanColumns& of = story.columns;
  for (std::size_t k = 0; k < of.keys.size(); ++k) {
    const analysis::Axis& axis = story.plan.axes[k];
    PlanColumn column{.kind = PlanColumn::Kind::key, .name = of.keys[k].key, .unit = of.keys[k].unit};
    column.logarithmic = axis.values.empty() && axis.spacing == analysis::Spacing::logarithmic;
    if (has_words(axis))
      for (const std::string& value : axis.values) column.words.emplace_back(analysis::bare(value));
    columns.push_back(std::move(column));
  }
  for (const analysis::InputColumn& c : of.strayed)
    columns.push_back({.kind = PlanColumn::Kind::strayed, .name = c.key, .unit = c.unit});
  for (const analysis::FigureColumn& f : of.figures)
    columns.push_back({.kind = PlanColumn::Kind::figure,
                       .name = f.name,
                       .unit = f.unit,
                       .required = f.required,
                       .min = f.min,
                       .max = f.max});
  return columns;
}

float key_value(const PlanColumn& column, const std::string& written) {
  if (column.words.empty()) return static_cast<float>(text::number_alone(written).value_or(no_value));
  const auto found = std::find(column.words.begin(), column.words.end(), analysis::bare(written));
  return found == column.words.end() ? no_value : static_cast<float>(found - column.words.begin());
}

void add(PlanRows& rows, const analysis::RunRecord& record) {
  rows.numbers.push_back(static_cast<double>(record->number));
  rows.states.push_back(static_cast<std::uint8_t>(state_of(record)));
  std::size_t c = 0;
  for (const std::string& value : record->point) {
    PlanColumn& column = rows.columns[c++];
    column.values.push_back(key_value(column, value));
  }
  for (const std::vector<double>* numbers : {&record->strayed, &record->figures})
    for (const double x : *numbers) rows.columns[c++].values.push_back(static_cast<float>(x));
}

}  // namespace

RunState state_of(const analysis::RunRecord& record) {
  if (record->end == analysis::RunEnd::refused) return RunState::refused;
  if (record->end == analysis::RunEnd::fault) return RunState::fault;
  return analysis::passed(record) ? RunState::holds : RunState::misses;
}

PlanRows plan_rows(const text::PlanStory& story, std::size_t most) {
  PlanRows rows;
  rows.every = std::max<std::size_t>(1, (story.series.runs + most - 1) / most);
  rows.columns = columns_of(story);
  std::size_t n = 0;
  story.each([&](const analysis::RunRecord& record) {
    if (n++ % rows.every == 0) add(rows, record);
  });
  return rows;
}

void Span::include(double x) {
  if (!std::isfinite(x)) return;
  low = std::min(low, x);
  high = std::max(high, x);
}

void Span::include(const Span& other) {
  include(other.low);
  include(other.high);
}

std::vector<Span> figure_spans(const text::PlanStory& story) {
  std::vector<Span> spans(story.columns.figures.size());
  story.each([&](const analysis::RunRecord& record) {
    for (std::size_t f = 0; f < spans.size(); ++f) spans[f].include(record->figures[f]);
  });
  return spans;
}

std::vector<Histogram> histograms(const text::PlanStory& story, const std::vector<Span>& spans) {
  std::vector<Histogram> out(spans.size());
  story.each([&](const analysis::RunRecord& record) {
    for (std::size_t f = 0; f < out.size(); ++f) {
      const double x = record->figures[f], width = spans[f].high - spans[f].low;
      if (std::isnan(x)) ++out[f].missing;
      if (std::isinf(x)) ++out[f].never;
      if (!std::isfinite(x)) continue;
      const double part = width > 0 ? (x - spans[f].low) / width : 0.5;
      const auto bin = static_cast<std::size_t>(std::clamp(part, 0.0, 1.0) * histogram_bins);
      ++out[f].counts[std::min(bin, histogram_bins - 1)];
    }
  });
  return out;
}

}  // namespace report
