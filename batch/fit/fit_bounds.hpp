// SPDX-License-Identifier: Apache-2.0
// Computes bounds of 95 % for a fit's unknowns.
#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "batch/fit/fit_solver.hpp"

namespace batch {

/// Covariance of the unknowns at a solution, in the order of the parameters; 0 for fixed unknowns.
struct FitCovariance {
  Eigen::MatrixXd of_white_noise;  ///< covariance for residuals that are independent from row to row
  Eigen::MatrixXd covariance;      ///< covariance for the actual correlation of the residuals
  double degrees_of_freedom = 0.0;
};

/// If residuals of consecutive rows of one column are correlated, the covariance is summed over the lags (Newey and West).
FitCovariance covariance_of(const FitProblem& problem, const Eigen::MatrixXd& derivatives,
                            const Eigen::VectorXd& residuals, const std::vector<bool>& free);

/// Correlation of consecutive residuals of one group.
double lag_correlation(const FitProblem& problem, const Eigen::VectorXd& residuals, std::size_t group);

struct UnknownBounds {
  double low = 0.0, high = 0.0;  ///< bounds of u
  bool by_profile = false;
};

/// Bounds of the unknown k. If the sum of squares increases like a parabola there: the value -+ Student's
/// width. Otherwise: the values of u at which the sum of squares, minimised over all other unknowns, has
/// increased by the same amount.
base::Result<UnknownBounds> bounds_of(FitProblem& problem, const FitSolution& solution,
                                      const FitCovariance& covariance, const std::vector<bool>& free,
                                      std::size_t k);

}  // namespace batch
