// SPDX-License-Identifier: Apache-2.0
// Finds the unknowns with the least sum of squares. The method is MINPACK's lmder in Eigen's port, which
// needs no further package. Ceres has the same method, but would add 60 MB.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "batch/fit/fit_problem.hpp"

namespace batch {

struct FitSolution {
  Eigen::VectorXd u, residuals;
  bool converged = false;

  double square() const { return residuals.squaredNorm(); }
};

/// Starts at `u`. Fixed unknowns keep their values. `evaluations`: largest number of trials. Problems: the start cannot
/// be simulated, the search was stopped. A trial that cannot be simulated is refused as a step.
base::Result<FitSolution> solve(FitProblem& problem, const Eigen::VectorXd& u, const std::vector<bool>& free,
                                int evaluations);

}  // namespace batch
