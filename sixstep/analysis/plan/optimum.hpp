// SPDX-License-Identifier: Apache-2.0
// Result of an optimisation: the best point of a plan's ranges, and its limits.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace sixstep::analysis {

/// A bound that the optimum touches: without it, the figure's least value would be smaller.
struct Limit {
  std::string what;    ///< a requirement's figure, or a key
  bool upper = false;  ///< true: its upper bound; false: its lower bound
  bool of_key = false;
};

struct Optimum {
  std::vector<std::string> point;  ///< the best point: a value per key, as a file writes it
  std::vector<double> values;      ///< the same values as numbers, in the keys' units
  /// The worst value of each figure over all drives.
  std::vector<double> figures;
  bool holds = false;  ///< true: every drive meets every requirement
  /// True if the search ended by itself. Otherwise it used all allowed points or was stopped; more points may
  /// find a smaller figure.
  bool converged = false;
  std::vector<Limit> limits;
  std::size_t evaluations = 0, at = 0;  ///< number of points that were tried, and index of the best point
};

}  // namespace sixstep::analysis
