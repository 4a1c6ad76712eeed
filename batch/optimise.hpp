// SPDX-License-Identifier: Apache-2.0
// Finds the best point in a plan's ranges: the least value of one figure at which every drive meets every
// requirement. Uses NLopt's COBYLA (M. J. D. Powell 1994, S. G. Johnson), which needs no gradients: figures
// of a switching simulation have no useful gradients.
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
  const analysis::Plan& plan;  ///< its axes must be ranges; it may have several drives at each point
  analysis::TableColumns columns;
  std::size_t figure = 0;         ///< column of the figure to be minimised
  std::size_t evaluations = 200;  ///< largest number of points
  /// The drive of a point. Several threads may call it at the same time.
  std::function<base::Result<analysis::PlannedRun>(const std::vector<std::string>& point, std::size_t drive)>
      scenario;
  /// Returns the stored row, if there is one. `number` = evaluation index * drives per point + drive index,
  /// both from 0. A row of another point is not used.
  std::function<std::optional<analysis::RunRecord>(std::size_t number)> known;
  std::function<void(analysis::RunRecord&&)> take;        ///< receives each new row, from any thread
  std::function<void(std::size_t evaluations)> progress;  ///< receives the number of points tried so far
  std::stop_token stop;
  unsigned jobs = 0;
};

/// The Problem of a machine on which NLopt cannot be loaded.
base::Problems missing_optimiser();

/// Runs the search. Requires missing_optimiser() to be empty. Half of the points, but at most ten per key, are
/// spread evenly over the ranges. Then COBYLA continues from the best of these points. The same input gives the
/// same sequence of points with any number of threads. Empty if the search was stopped before its first point
/// was complete, or if no point could run.
std::optional<analysis::Optimum> optimise(const Optimisation& work);

}  // namespace batch
