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

/// Distance to the nearer bound in the figure's unit, negative beyond it; minus infinity for a figure that never
/// comes or has no value, infinity without a bound.
double margin(const FigureColumn& column, double x);

struct SpreadFigure {
  FigureColumn column;
  std::size_t holds = 0;  ///< runs whose value meets the requirement; a faulted run counts too
  /// Of a requirement: the run with the least margin(), the first of several. A run that could not start is none.
  std::optional<std::size_t> worst;
  double least_margin = 0.0;  ///< that run's
  bool missed = false;        ///< whether a run that could start misses it
  Statistics statistics;
};

/// A run that failed; its number is enough to repeat it.
struct Casualty {
  std::size_t number = 0;
  std::string problem;
};

/// A remark that some runs have, perhaps with other numbers in it.
struct SeriesRemark {
  std::string text;                  ///< as its first run has it
  std::vector<std::size_t> numbers;  ///< its runs
};

struct Series {
  std::size_t runs = 0;               ///< all: ended, stopped by a fault, or could not start
  std::size_t passed = 0;             ///< meet every requirement
  std::vector<SpreadFigure> figures;  ///< a figure each, in the columns' order
  std::vector<Casualty> faults;       ///< stopped by a fault
  std::vector<Casualty> refused;      ///< could not start
  std::vector<SeriesRemark> remarks;  ///< in the order of their first runs
  std::uint64_t digest = 0;           ///< digest of all runs' digests, in the order of their numbers
};

Series series_of(const PlanColumns& columns);

/// Adds a row, in the order of the runs' numbers. Figures of a run that a fault stopped count as they were at the
/// stop.
void add(Series& series, const RunRecord& record);

}  // namespace sixstep::analysis
