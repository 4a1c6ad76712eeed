// SPDX-License-Identifier: Apache-2.0
// The least-squares problem of a fit. It computes the residuals of all benches, each divided by the noise of
// its column, and their derivatives with respect to the unknowns.
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "batch/fit/fit_model.hpp"

namespace batch {

class FitProblem {
 public:
  FitProblem(const FitRequest& request, std::vector<FitModel> models, std::vector<FitParameter> parameters);

  /// Number of cells in use, and number of residuals. There is one more residual for each unknown: u itself.
  /// So a start value counts as known to a factor of e (one standard deviation), and the problem has a
  /// solution even if the recordings do not determine an unknown.
  std::size_t cells() const { return group_.size(); }
  std::size_t rows() const { return cells() + parameters_.size(); }
  /// Restricts the problem to the first part of each recording's time, 0 to 1.
  void use(double part);
  const std::vector<FitParameter>& parameters() const { return parameters_; }
  const std::vector<FitModel>& models() const { return models_; }
  /// The columns of all benches: each is a group of cells with the same noise.
  std::size_t groups() const { return noise_.size(); }
  std::size_t group_of(std::size_t row) const { return group_[row]; }
  double noise(std::size_t group) const { return noise_[group]; }
  /// Width of the steps in which a group was recorded, relative to its noise; 0: no steps.
  double step(std::size_t group) const { return step_[group] / noise_[group]; }
  /// Recorded value of a cell, relative to the noise of its column.
  double recorded(std::size_t cell) const {
    return recorded_[static_cast<Eigen::Index>(cell)] / noise_[group_[cell]];
  }
  std::size_t simulations() const { return simulations_; }
  bool stopped() const { return stopped_; }

  /// Recorded value minus model for each cell, relative to the noise of its column. Problems: as
  /// FitModel::values().
  base::Result<Eigen::VectorXd> residuals(const Eigen::VectorXd& u);
  /// Derivatives of residuals() with respect to the free unknowns, by central differences. Columns of fixed
  /// unknowns are 0.
  base::Result<Eigen::MatrixXd> derivatives(const Eigen::VectorXd& u, const std::vector<bool>& free);
  /// Sets the noise of each column to the rms of its residuals. Returns the largest relative change.
  double take_noise(const Eigen::VectorXd& residuals, std::size_t free);

 private:
  base::Result<Eigen::VectorXd> model(const Eigen::VectorXd& u);

  const FitRequest& request_;
  std::vector<FitModel> models_;
  std::vector<FitParameter> parameters_;
  std::vector<std::size_t> counts_;  ///< number of used cells of each model
  std::vector<std::size_t> group_;   ///< group of each used cell
  std::vector<double> noise_;        ///< noise of each group
  std::vector<double> step_;         ///< width of the steps of each group
  std::vector<double> span_;         ///< span of each group: highest minus lowest recorded value
  Eigen::VectorXd recorded_;
  std::size_t simulations_ = 0;
  bool stopped_ = false;
};

}  // namespace batch
