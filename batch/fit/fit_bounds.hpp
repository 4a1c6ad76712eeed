// SPDX-License-Identifier: Apache-2.0
// Bounds of 95 % of a fit's unknowns.
#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "batch/fit/fit_solver.hpp"

namespace batch {

/// Covariance of the free unknowns at a solution, in the order of the parameters; 0 for fixed ones.
struct FitCovariance {
  Eigen::MatrixXd of_white_noise;  ///< for residuals that are independent from row to row
  Eigen::MatrixXd covariance;      ///< for the residuals as they are correlated, and for a rough model
  Eigen::MatrixXd roughness;       ///< part of `covariance` by the model's roughness
  /// Growth of each unknown's variance if the start counts a hundredth. 1: the recordings alone determine the unknown.
  Eigen::VectorXd growth_without_start;
  double degrees_of_freedom = 0.0;
};

/// If residuals of consecutive rows of one column are correlated, the covariance is summed over the lags (Newey and West).
FitCovariance covariance_of(const FitProblem& problem, const Eigen::MatrixXd& derivatives,
                            const Eigen::VectorXd& residuals, const std::vector<bool>& free);

/// Estimates of the unknowns by one Gauss-Newton step each from points around the solution. In a smooth model all of them
/// are the solution. Firmware that samples makes the model rough: the estimates are spread around the smooth model's.
struct Estimates {
  Eigen::VectorXd mean;
  Eigen::MatrixXd spread;  ///< covariance of one estimate, without the curvature of the model
};

/// `determined`: the unknowns that are moved. Problems: as FitModel::values().
base::Result<Estimates> estimates_around(FitProblem& problem, const FitSolution& solution,
                                         const Eigen::MatrixXd& derivatives, const FitCovariance& covariance,
                                         const std::vector<bool>& determined);

/// Correlation of consecutive residuals of one group.
double lag_correlation(const FitProblem& problem, const Eigen::VectorXd& residuals, std::size_t group);

struct UnknownBounds {
  double low = 0.0, high = 0.0;  ///< of u
  bool by_profile = false;
};

/// Bounds of the unknown k: its value -+ Student's width, if the sum of squares grows there as a parabola does; else
/// the values at which the sum of squares, least over all other unknowns, has grown by the same amount.
base::Result<UnknownBounds> bounds_of(FitProblem& problem, const FitSolution& solution,
                                      const FitCovariance& covariance, const std::vector<bool>& free,
                                      std::size_t k);

}  // namespace batch
