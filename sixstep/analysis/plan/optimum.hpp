// SPDX-License-Identifier: Apache-2.0
// The best point of a plan's ranges, and what limits it.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace sixstep::analysis {

/// What keeps the figure from being smaller.
struct Limit {
  std::string what;    ///< a requirement's figure, or a key
  bool upper = false;  ///< its greatest value, else its least
  bool of_key = false;
};

struct Optimum {
  std::vector<std::string> point;  ///< a value per key, as a file writes it
  std::vector<double> values;      ///< the same as numbers, in the keys' units
  std::vector<double>
      figures;         ///< of the worst drive there: each as far towards its limit as any drive has it
  bool holds = false;  ///< every drive every requirement
  /// The search ended by itself. Else its points were used up or it was stopped: more of them may find a smaller figure.
  bool converged = false;
  std::vector<Limit> limits;
  std::size_t evaluations = 0, at = 0;  ///< points that were tried; the one that is best
};

}  // namespace sixstep::analysis
