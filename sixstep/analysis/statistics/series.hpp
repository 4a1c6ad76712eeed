// SPDX-License-Identifier: Apache-2.0
// Evaluates many runs together: the spread of each figure, and how many runs meet each requirement.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sixstep/analysis/plan/plan_table.hpp"
#include "sixstep/analysis/statistics/statistics.hpp"

namespace sixstep::analysis {

/// Distance from the nearer bound in the figure's unit; negative beyond the bound. Minus infinity if the
/// figure has no value or its event never occurs; infinity without a bound.
double margin(const FigureColumn& column, double x);

struct SpreadFigure {
  FigureColumn column;
  std::size_t holds = 0;  ///< number of runs whose value meets the requirement, including runs stopped by a
                          ///< fault
  /// For a requirement: the run with the least margin(), the first if there are several. Runs that could not
  /// start are skipped.
  std::optional<std::size_t> worst;
  double least_margin = 0.0;  ///< margin of the worst run
  bool missed = false;        ///< true: a run that could start does not meet the requirement
  Statistics statistics;
};

/// A run that failed; its number is enough to repeat it.
struct Casualty {
  std::size_t number = 0;
  std::string problem;
};

/// A remark of some runs, possibly with different numbers in its text.
struct SeriesRemark {
  std::string text;                  ///< text in the first run
  std::vector<std::size_t> numbers;  ///< numbers of the runs with this remark
  bool differs = false;              ///< true: the numbers in the text differ between runs
};

struct Series {
  std::size_t runs = 0;               ///< all runs: ended, stopped by a fault, or could not start
  std::size_t passed = 0;             ///< runs that meet every requirement
  std::vector<SpreadFigure> figures;  ///< one per figure, in the columns' order
  std::vector<Casualty> faults;       ///< runs that a fault stopped
  std::vector<Casualty> refused;      ///< runs that could not start
  std::vector<SeriesRemark> remarks;  ///< in the order of their first runs
  std::uint64_t digest = 0;           ///< digest of all runs' digests, in the order of their numbers
};

Series series_of(const PlanColumns& columns);

/// Adds a row; rows must be in the order of the runs' numbers. If a fault stopped a run, its figures have
/// their values at the stop.
void add(Series& series, const RunRecord& record);

}  // namespace sixstep::analysis
