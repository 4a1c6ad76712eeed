// SPDX-License-Identifier: Apache-2.0
// Result of an optimisation: the best point of a plan's ranges, and its limits.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace sixstep::analysis {

/// A bound that determines the figure's least value.
struct Limit {
  std::string what;    ///< a requirement's figure, or a key
  bool upper = false;  ///< its greatest value, else its least
  bool of_key = false;
};

struct Optimum {
  std::vector<std::string> point;  ///< a value per key, as a file writes it
  std::vector<double> values;      ///< the same as numbers, in the keys' units
  /// Each figure's worst value over all drives.
  std::vector<double> figures;
  bool holds = false;  ///< every drive meets every requirement
  /// The search ended by itself. Otherwise its points were used up or it was stopped, and more points may find a
  /// smaller figure.
  bool converged = false;
  std::vector<Limit> limits;
  std::size_t evaluations = 0, at = 0;  ///< points that were tried; the best one
};

}  // namespace sixstep::analysis
