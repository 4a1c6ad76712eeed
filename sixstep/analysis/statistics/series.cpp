// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/statistics/series.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sixstep/base/hash.hpp"

namespace sixstep::analysis {
namespace {

/// True if two remarks differ only in their numbers: they are then the same remark of two runs.
bool differs_in_numbers_alone(const std::string& a, const std::string& b) {
  const auto words = [](std::string text) {
    std::erase_if(text, [](char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+'; });
    return text;
  };
  return a == b || words(a) == words(b);
}

void add_remark(std::vector<SeriesRemark>& remarks, const std::string& text, std::size_t number) {
  const auto known = std::ranges::find_if(
      remarks, [&text](const SeriesRemark& r) { return differs_in_numbers_alone(r.text, text); });
  if (known == remarks.end()) return void(remarks.push_back({text, {number}}));
  if (known->numbers.back() != number) known->numbers.push_back(number);
  known->differs = known->differs || known->text != text;
}

}  // namespace

double margin(const FigureColumn& column, double x) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  if (std::isnan(x)) return -infinite;
  double least = infinite;
  if (column.min) least = std::min(least, x - *column.min);
  if (column.max) least = std::min(least, *column.max - x);
  return least;
}

Series series_of(const PlanColumns& columns) {
  Series series;
  for (const FigureColumn& column : columns.figures)
    series.figures.push_back({.column = column, .worst = {}, .statistics = {}});
  return series;
}

void add(Series& series, const RunRecord& record) {
  bool all = record->end == RunEnd::whole;
  for (std::size_t n = 0; n < series.figures.size(); ++n) {
    SpreadFigure& figure = series.figures[n];
    figure.statistics.add(record->figures[n]);
    const bool holds = record->end != RunEnd::refused && figure.column.holds(record->figures[n]);
    figure.holds += holds;
    figure.missed = figure.missed || (!holds && record->end != RunEnd::refused);
    const double left = margin(figure.column, record->figures[n]);
    if (figure.column.required && record->end != RunEnd::refused &&
        (!figure.worst || left < figure.least_margin)) {
      figure.worst = record->number;
      figure.least_margin = left;
    }
    all = all && holds;
  }
  if (record->end == RunEnd::fault) series.faults.push_back({record->number, record->problem});
  if (record->end == RunEnd::refused) series.refused.push_back({record->number, record->problem});
  for (const std::string& remark : record->remarks) add_remark(series.remarks, remark, record->number);
  series.passed += all;
  base::Hash hash;
  hash.word(series.digest);
  hash.word(record->digest);
  series.digest = hash.value();
  ++series.runs;
}

}  // namespace sixstep::analysis
