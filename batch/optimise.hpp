// SPDX-License-Identifier: Apache-2.0
// The best point of a plan's ranges: least of one figure, with every requirement held by every drive. (NLopt's COBYLA: it takes
// limits without their slopes, which figures of a switching simulation do not have; M. J. D. Powell 1994, S. G. Johnson.)
#pragma once
#include <cstddef>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "batch/rooms.hpp"
#include "sixstep/analysis/plan/optimum.hpp"
#include "sixstep/analysis/plan/plan_table.hpp"

namespace batch {

struct Optimisation {
  const analysis::Plan& plan;  ///< ranges alone; drives at each point
  analysis::TableColumns columns;
  std::size_t figure = 0;         ///< that is to be small: its column
  std::size_t evaluations = 200;  ///< of points, at most
  /// The drive of a point. Called on any thread, several at once.
  std::function<base::Result<analysis::PlannedRun>(const std::vector<std::string>& point, std::size_t drive)>
      scenario;
  /// A row that is known already: evaluation times drives, plus the drive. It counts where its point is the one wanted.
  std::function<std::optional<analysis::RunRecord>(std::size_t number)> known;
  std::function<void(analysis::RunRecord&&)> take;        ///< each that is new; on any thread
  std::function<void(std::size_t evaluations)> progress;  ///< how many points have been tried
  std::stop_token stop;
  unsigned jobs = 0;
};

/// Half of the points, but ten for each key at most, are spread evenly over the ranges, then COBYLA goes on from the best. The
/// same input takes the same way, whatever the number of threads. Empty where it was stopped before its first point was whole, or
/// none of them could run.
std::optional<analysis::Optimum> optimise(const Optimisation& work);

}  // namespace batch
