// SPDX-License-Identifier: Apache-2.0
// A series of drives judged together: how each figure strays, and how many drives hold each requirement.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sixstep/analysis/series/statistics.hpp"
#include "sixstep/base/result.hpp"
#include "sixstep/study/measure/outcome.hpp"

namespace sixstep::analysis {

struct SpreadFigure {
  std::string figure, unit;
  bool required = false;                  ///< else only compared
  std::optional<double> min, max;         ///< the requirement
  std::size_t holds = 0;                  ///< runs that hold it
  std::optional<std::size_t> first_miss;  ///< number of the first run that does not
  Statistics statistics;
};

/// A run to look at: its number is all that is needed to repeat it (study::varied).
struct Casualty {
  std::size_t number = 0;
  base::Problem problem;
};

struct Series {
  std::size_t runs = 0;               ///< that came to an end or a fault, or could not start
  std::size_t passed = 0;             ///< hold every requirement
  std::vector<SpreadFigure> figures;  ///< requirements first, in the scenario's order
  std::vector<Casualty> faults;       ///< stopped by a fault
  std::vector<Casualty> refused;      ///< could not start
  std::uint64_t digest = 0;           ///< of all runs' digests, in order
};

/// One result more. Figures of runs that a fault stopped count as they were when it stopped.
void add(Series& series, const base::Result<study::Outcome>& result);

}  // namespace sixstep::analysis
