// SPDX-License-Identifier: Apache-2.0
#include "batch/fit/fit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "batch/fit/fit_determined.hpp"
#include "sixstep/analysis/identification/distributions.hpp"

namespace batch {

namespace {

using Index = Eigen::Index;

/// Largest number of trials of one search. A search from a good start needs about ten.
constexpr int most_trials = 80;

class Fitting {
 public:
  explicit Fitting(FitProblem problem)
      : problem_(std::move(problem)), free_(problem_.parameters().size(), true) {
    solution_.u = Eigen::VectorXd::Zero(static_cast<Index>(free_.size()));
  }

  base::Result<Fit> run() {
    base::Problems problems = approach();
    if (problems.empty()) problems = settle();
    if (problems.empty()) problems = hold_frictions();
    if (problems.empty()) problems = bound();
    if (!problems.empty()) return problems;
    tell_columns();
    out_.simulations = problem_.simulations();
    out_.converged = solution_.converged;
    return std::move(out_);
  }

 private:
  /// Approaches the solution over longer and longer first parts of the recordings. If a start value is wrong
  /// by a third, the simulated rotor deviates by whole turns after some time, and the sum of squares has a
  /// local minimum at each turn. Within a short part it has one minimum.
  base::Problems approach() {
    for (const double part : {0.03, 0.06, 0.12, 0.25, 0.5, 1.0}) {
      problem_.use(part);
      if (problem_.cells() < 5) continue;
      for (int round = 0; round < 2; ++round)
        if (base::Problems problems = improve(12); !problems.empty()) return problems;
    }
    return {};
  }

  /// Repeats the search until each column's noise equals the rms of its residuals. Then computes derivatives
  /// and covariance.
  base::Problems settle() {
    for (int round = 0; round < 4; ++round) {
      if (base::Problems problems = improve(most_trials); !problems.empty()) return problems;
      if (change_ < 0.05) break;
    }
    base::Result<Eigen::VectorXd> residuals = problem_.residuals(solution_.u);  // in the latest noise
    if (!residuals) return residuals.problems();
    solution_.residuals = std::move(*residuals);
    base::Result<Eigen::MatrixXd> derivatives = problem_.derivatives(solution_.u, free_);
    if (!derivatives) return derivatives.problems();
    derivatives_ = std::move(*derivatives);
    covariance_ = covariance_of(problem_, derivatives_, solution_.residuals, free_);
    return {};
  }

  base::Problems improve(int trials) {
    base::Result<FitSolution> found = solve(problem_, solution_.u, free_, trials);
    if (!found) return found.problems();
    solution_ = std::move(*found);
    for (std::size_t k = 0; k < free_.size(); ++k) {  // a friction below 0 has no effect and no derivative
      const FitParameter& p = problem_.parameters()[k];
      double& u = solution_.u[static_cast<Index>(k)];
      if (p.positive) u = std::max(u, -p.start / p.scale);
    }
    change_ = problem_.take_noise(solution_.residuals, count());
    return {};
  }

  /// Fixes each friction at 0 whose best value is not above 0. The upper bound then follows from the linear
  /// problem.
  base::Problems hold_frictions() {
    bool held = false;
    for (std::size_t k = 0; k < free_.size(); ++k) {
      const FitParameter& p = problem_.parameters()[k];
      const auto at = static_cast<Index>(k);
      if (!free_[k] || !p.positive || p.value(solution_.u[at]) > 0.0 || !is_determined(covariance_, k))
        continue;
      const double step = covariance_.of_white_noise.row(at) * derivatives_.transpose() * solution_.residuals;
      const double width =
          analysis::student_95(covariance_.degrees_of_freedom) * std::sqrt(covariance_.covariance(at, at));
      const double zero = -p.start / p.scale;
      out_.values.push_back({p.key,
                             "",
                             p.unit,
                             p.start,
                             {0.0, 0.0, p.value(std::max(zero, zero - std::fabs(step) + width))},
                             false,
                             true});
      free_[k] = false;
      solution_.u[at] = zero;
      held = true;
    }
    return held ? settle() : base::Problems{};
  }

  base::Problems bound() {
    for (std::size_t k = 0; k < free_.size(); ++k) {
      const FitParameter& p = problem_.parameters()[k];
      if (!free_[k]) continue;
      if (!is_determined(covariance_, k)) {
        out_.undetermined.push_back({p.key, bench_of(p), p.unit, p.start,
                                     why_undetermined(problem_, derivatives_, covariance_, k),
                                     recording_for(p)});
        continue;
      }
      const base::Result<UnknownBounds> bounds = bounds_of(problem_, solution_, covariance_, free_, k);
      if (!bounds) return bounds.problems();
      const double u = solution_.u[static_cast<Index>(k)];
      out_.values.push_back({p.key,
                             bench_of(p),
                             p.unit,
                             p.start,
                             {p.value(u), p.value(bounds->low), p.value(bounds->high)},
                             bounds->by_profile,
                             false});
    }
    return {};
  }

  void tell_columns() {
    std::size_t group = 0;
    std::size_t before = 0;
    for (const FitModel& model : problem_.models()) {
      const study::Trace& log = model.bench().log;
      for (std::size_t c = 1; c < log.columns.size(); ++c, ++group) {
        FitColumn column{model.bench().name,
                         log.columns[c],
                         {},
                         {},
                         {},
                         problem_.noise(group),
                         lag_correlation(problem_, solution_.residuals, group)};
        for (std::size_t n = 0; n < model.cells().size(); ++n) {
          const FitCell& cell = model.cells()[n];
          if (cell.column != c) continue;
          column.t_s.push_back(log.values[0][cell.row]);
          column.recorded.push_back(cell.value);
          column.model.push_back(cell.value -
                                 solution_.residuals[static_cast<Index>(before + n)] * problem_.noise(group));
        }
        out_.columns.push_back(std::move(column));
      }
      before += model.cells().size();
    }
  }

  std::size_t count() const { return static_cast<std::size_t>(std::count(free_.begin(), free_.end(), true)); }
  std::string bench_of(const FitParameter& p) const {
    return p.role == FitRole::key ? std::string() : problem_.models()[p.bench].bench().name;
  }
  FitProblem problem_;
  std::vector<bool> free_;
  FitSolution solution_{};
  Eigen::MatrixXd derivatives_;
  FitCovariance covariance_;
  double change_ = 0.0;  ///< change of the columns' noise in the last search
  Fit out_;
};

}  // namespace

base::Result<Fit> fit(const FitRequest& request) {
  if (request.benches.empty())
    return base::Problem{"fit", "", "needs a recording", "give a recording and its scenario"};
  base::Result<std::vector<FitParameter>> parameters = fit_parameters(request);
  if (!parameters) return parameters.problems();
  std::vector<FitModel> models;
  for (std::size_t n = 0; n < request.benches.size(); ++n) {
    base::Result<FitModel> model = FitModel::of(request.benches[n], n);
    if (!model) return model.problems();
    models.push_back(std::move(*model));
  }
  FitProblem problem(request, std::move(models), std::move(*parameters));
  if (problem.rows() <= problem.parameters().size() + 2)
    return base::Problem{
        "free", std::to_string(problem.parameters().size()),
        "parameters are free, and the recordings have " + std::to_string(problem.rows()) + " values",
        "free fewer parameters, or record more rows"};
  return Fitting(std::move(problem)).run();
}

}  // namespace batch
