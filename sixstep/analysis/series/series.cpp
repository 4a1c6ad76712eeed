// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/series/series.hpp"

#include <limits>

#include "sixstep/base/hash.hpp"

namespace sixstep::analysis {
namespace {

/// The figures that every run of a series has, from the first that started. Earlier ones had none of them.
std::vector<SpreadFigure> figures_of(const study::Outcome& outcome, std::size_t runs_before) {
  std::vector<SpreadFigure> figures;
  for (const study::Verdict& v : outcome.verdicts)
    figures.push_back({v.figure, v.unit, true, v.min, v.max, 0, {}, {}});
  for (const study::ComparisonResult& c : outcome.comparisons)
    figures.push_back({c.figure, c.unit, false, {}, {}, 0, {}, {}});
  for (SpreadFigure& figure : figures)
    for (std::size_t n = 0; n < runs_before; ++n)
      figure.statistics.add(std::numeric_limits<double>::quiet_NaN());
  return figures;
}

void add_outcome(Series& series, const study::Outcome& outcome) {
  if (series.figures.empty()) series.figures = figures_of(outcome, series.runs);
  auto figure = series.figures.begin();
  for (const study::Verdict& v : outcome.verdicts) {
    figure->statistics.add(v.measured);
    const bool holds = v.ok && !outcome.fault;
    figure->holds += holds;
    if (!holds && !figure->first_miss) figure->first_miss = series.runs;
    ++figure;
  }
  for (const study::ComparisonResult& c : outcome.comparisons) (figure++)->statistics.add(c.measured);
  if (outcome.fault) series.faults.push_back({series.runs, *outcome.fault});
  series.passed += outcome.passed();
}

}  // namespace

void add(Series& series, const base::Result<study::Outcome>& result) {
  if (result) {
    add_outcome(series, *result);
  } else {
    for (SpreadFigure& figure : series.figures)
      figure.statistics.add(std::numeric_limits<double>::quiet_NaN());
    series.refused.push_back({series.runs, result.problems().front()});
  }
  base::Hash hash;
  hash.word(series.digest);
  hash.word(result ? result->digest : 0);
  series.digest = hash.value();
  ++series.runs;
}

}  // namespace sixstep::analysis
