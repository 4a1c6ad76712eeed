// SPDX-License-Identifier: Apache-2.0
// Many runs judged together: how each figure strays, and how many runs hold each requirement.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sixstep/analysis/plan/plan_table.hpp"
#include "sixstep/analysis/statistics/statistics.hpp"

namespace sixstep::analysis {

struct SpreadFigure {
  FigureColumn column;
  std::size_t holds = 0;  ///< runs whose value holds it, as a run alone says; a fault is told beside it
  std::optional<std::size_t> first_miss;  ///< number of the first run whose value does not
  Statistics statistics;
};

/// A run to look at: its number is all that is needed to repeat it.
struct Casualty {
  std::size_t number = 0;
  std::string problem;
};

struct Series {
  std::size_t runs = 0;               ///< that came to an end or a fault, or could not start
  std::size_t passed = 0;             ///< hold every requirement
  std::vector<SpreadFigure> figures;  ///< a figure each, in the columns' order
  std::vector<Casualty> faults;       ///< stopped by a fault
  std::vector<Casualty> refused;      ///< could not start
  std::uint64_t digest = 0;           ///< of all runs' digests, in the order of their numbers
};

Series series_of(const PlanColumns& columns);

/// One row more, in the order of the runs' numbers. Figures of runs that a fault stopped count as they were when it stopped.
void add(Series& series, const RunRecord& record);

}  // namespace sixstep::analysis
