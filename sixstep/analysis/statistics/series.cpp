// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/statistics/series.hpp"

#include "sixstep/base/hash.hpp"

namespace sixstep::analysis {

Series series_of(const PlanColumns& columns) {
  Series series;
  for (const FigureColumn& column : columns.figures)
    series.figures.push_back({.column = column, .first_miss = {}, .statistics = {}});
  return series;
}

void add(Series& series, const RunRecord& record) {
  bool all = record->end == RunEnd::whole;
  for (std::size_t n = 0; n < series.figures.size(); ++n) {
    SpreadFigure& figure = series.figures[n];
    figure.statistics.add(record->figures[n]);
    const bool holds = record->end != RunEnd::refused && figure.column.holds(record->figures[n]);
    figure.holds += holds;
    if (!holds && record->end != RunEnd::refused && !figure.first_miss) figure.first_miss = record->number;
    all = all && holds;
  }
  if (record->end == RunEnd::fault) series.faults.push_back({record->number, record->problem});
  if (record->end == RunEnd::refused) series.refused.push_back({record->number, record->problem});
  series.passed += all;
  base::Hash hash;
  hash.word(series.digest);
  hash.word(record->digest);
  series.digest = hash.value();
  ++series.runs;
}

}  // namespace sixstep::analysis
