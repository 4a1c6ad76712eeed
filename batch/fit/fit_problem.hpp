// SPDX-License-Identifier: Apache-2.0
// The least-squares problem of a fit: residuals of all benches over the unknowns, each divided by the noise of its
// column, and their derivatives.
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

  /// Cells that count at present, and residuals: one more for each unknown, which is u itself. So the start counts as known
  /// to a factor of e (one standard deviation), which holds whatever the recordings do not determine.
  std::size_t cells() const { return group_.size(); }
  std::size_t rows() const { return cells() + parameters_.size(); }
  /// Restricts the problem to the first part of each recording's time, 0 to 1.
  void use(double part);
  /// Lets the frictions grow with the inertia, or not, and returns the same values as unknowns of that choice. Coasting
  /// determines frictions divided by the inertia: if they grow with it, a search can change the inertia alone.
  Eigen::VectorXd with_frictions_of_inertia(bool of_inertia, const Eigen::VectorXd& u);
  const std::vector<FitParameter>& parameters() const { return parameters_; }
  const std::vector<FitModel>& models() const { return models_; }
  /// Columns of all benches, as groups of cells with one noise each.
  std::size_t groups() const { return noise_.size(); }
  std::size_t group_of(std::size_t row) const { return group_[row]; }
  double noise(std::size_t group) const { return noise_[group]; }
  /// Width of the steps in which a group was recorded, in its noise; 0: none is seen.
  double step(std::size_t group) const { return step_[group] / noise_[group]; }
  /// Recorded value of a cell, in the noise of its column.
  double recorded(std::size_t cell) const {
    return recorded_[static_cast<Eigen::Index>(cell)] / noise_[group_[cell]];
  }
  std::size_t simulations() const { return simulations_; }
  bool stopped() const { return stopped_; }

  /// Recorded less model for each cell, in the noise of its column. Problems: as FitModel::values().
  base::Result<Eigen::VectorXd> residuals(const Eigen::VectorXd& u);
  /// Derivatives of residuals() by the free unknowns, by central differences; the columns of fixed unknowns are 0. A step
  /// moves the model by about its noise: firmware that samples makes the model rough, and a wide step averages this.
  base::Result<Eigen::MatrixXd> derivatives(const Eigen::VectorXd& u, const std::vector<bool>& free);
  /// Sets the noise of each column to the rms of its residuals, or nearer to it; at least to `least` times the column's
  /// span. Returns the largest relative change.
  double take_noise(const Eigen::VectorXd& residuals, std::size_t free, double least);

 private:
  base::Result<Eigen::VectorXd> model(const Eigen::VectorXd& u);
  /// u with unknown k moved by `by`. If k is the inertia, the free frictions move with it: the model's difference is exactly 0
  /// where a recording determines only their quotients.
  Eigen::VectorXd moved(const Eigen::VectorXd& u, const std::vector<bool>& free, std::size_t k,
                        double by) const;
  /// Subtracts the frictions' part from the inertia's column.
  void part_inertia(const Eigen::VectorXd& u, const std::vector<bool>& free,
                    Eigen::MatrixXd& derivatives) const;
  void adapt_steps(const std::vector<bool>& free, const Eigen::MatrixXd& derivatives);

  const FitRequest& request_;
  std::vector<FitModel> models_;
  std::vector<FitParameter> parameters_;
  std::vector<std::size_t> counts_;  ///< number of used cells of each model
  std::vector<std::size_t> group_;   ///< for each used cell
  std::vector<double> noise_;        ///< for each group
  std::vector<double> step_;         ///< for each group
  std::vector<double> span_;         ///< for each group: highest less lowest recorded value
  std::vector<double> difference_;   ///< step of each unknown for derivatives
  Eigen::VectorXd recorded_;
  std::size_t simulations_ = 0;
  bool stopped_ = false;
};

}  // namespace batch
