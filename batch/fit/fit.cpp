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
/// Trials of a search whose result is only the start of the next one.
constexpr int few_trials = 12;

/// Least noise of a column, as a part of its span: while the search approaches, and at its end. A recording without noise
/// is a simulation.
constexpr double approach_noise = 0.01, least_noise = 1e-5;

class Fitting {
 public:
  explicit Fitting(FitProblem problem)
      : problem_(std::move(problem)), free_(problem_.parameters().size(), true), given_(free_.size()) {
    solution_.u = Eigen::VectorXd::Zero(static_cast<Index>(free_.size()));
  }

  base::Result<Fit> run() {
    base::Problems problems = approach();
    if (problems.empty()) problems = settle();
    if (problems.empty()) problems = hold_undetermined();
    if (problems.empty()) problems = hold_frictions();
    if (problems.empty()) problems = bound();
    if (!problems.empty()) return problems;
    tell_columns();
    out_.simulations = problem_.simulations();
    out_.converged = solution_.converged;
    return std::move(out_);
  }

 private:
  /// Approaches the solution over longer and longer parts of the recordings. With constants that are wrong by a third a
  /// simulated rotor loses step with the recorded one after some turns, and the sum of squares has a minimum at each of
  /// them. Within a short part it has one minimum.
  base::Problems approach() {
    solution_.u = problem_.with_frictions_of_inertia(true, solution_.u);
    for (const double part : {0.03, 0.06, 0.12, 0.25, 0.5, 1.0}) {
      problem_.use(part);
      if (problem_.cells() < 5) continue;
      for (int round = 0; round < 2; ++round)
        if (base::Problems problems = improve(few_trials, approach_noise); !problems.empty()) return problems;
    }
    base::Problems problems = search();
    solution_.u = problem_.with_frictions_of_inertia(false, solution_.u);
    return problems;
  }

  /// Searches until the noise of each column fits its residuals.
  base::Problems search() {
    for (int round = 0; round < 15; ++round) {
      if (base::Problems problems = improve(few_trials, least_noise); !problems.empty()) return problems;
      if (change_ < 0.05) break;
    }
    return improve(most_trials, least_noise);
  }

  /// Searches, then takes the derivatives and the covariance at the solution. In a rough model a search ends at one of many
  /// small minima; the mean of estimates from points around it is the smooth model's.
  base::Problems settle() {
    base::Problems problems = search();
    if (problems.empty()) problems = take_covariance();
    for (int round = 0; round < 4 && problems.empty(); ++round) {
      std::vector<bool> determined = free_;
      for (std::size_t k = 0; k < free_.size(); ++k)
        determined[k] = free_[k] && is_determined(covariance_, k);
      const base::Result<Estimates> around =
          estimates_around(problem_, solution_, derivatives_, covariance_, determined);
      if (!around) return around.problems();
      double farthest = 0.0;
      for (std::size_t k = 0; k < free_.size(); ++k) {
        const auto at = static_cast<Index>(k);
        if (!determined[k]) continue;
        const double move = around->mean[at] - solution_.u[at];
        farthest = std::max(farthest, std::fabs(move) / std::sqrt(covariance_.covariance(at, at)));
        solution_.u[at] = within_range(k, around->mean[at]);
      }
      problems = take_covariance();
      covariance_.roughness = around->spread;
      covariance_.covariance += around->spread;
      if (farthest < 0.3) break;
    }
    return problems;
  }

  base::Problems take_covariance() {
    base::Result<Eigen::VectorXd> residuals = problem_.residuals(solution_.u);  // in the latest noise
    if (!residuals) return residuals.problems();
    solution_.residuals = std::move(*residuals);
    base::Result<Eigen::MatrixXd> derivatives = problem_.derivatives(solution_.u, free_);
    if (!derivatives) return derivatives.problems();
    derivatives_ = std::move(*derivatives);
    covariance_ = covariance_of(problem_, derivatives_, solution_.residuals, free_);
    return {};
  }

  /// Below 0 a friction has no effect, and no derivative.
  double within_range(std::size_t k, double u) const {
    const FitParameter& p = problem_.parameters()[k];
    return p.positive ? std::max(u, -p.start / p.scale) : u;
  }

  base::Problems improve(int trials, double least) {
    base::Result<FitSolution> found = solve(problem_, solution_.u, free_, trials);
    if (!found) return found.problems();
    solution_ = std::move(*found);
    for (std::size_t k = 0; k < free_.size(); ++k)
      solution_.u[static_cast<Index>(k)] = within_range(k, solution_.u[static_cast<Index>(k)]);
    change_ = problem_.take_noise(solution_.residuals, count(), least);
    return {};
  }

  /// Holds at their starts the unknowns that the recordings do not determine: all without any effect, of others one after the
  /// other, because it often determines the rest. The fitted values, differences and charts then belong together.
  base::Problems hold_undetermined() {
    for (;;) {
      std::vector<std::size_t> held;
      for (std::size_t k = 0; k < free_.size(); ++k)
        if (free_[k] && is_without_effect(problem_, derivatives_, k)) held.push_back(k);
      for (std::size_t k = 0; k < free_.size() && held.empty(); ++k)
        if (free_[k] && !is_determined(covariance_, k)) held.push_back(k);
      if (held.empty()) return {};
      for (const std::size_t k : held) {
        const FitParameter& p = problem_.parameters()[k];
        out_.undetermined.push_back({p.key, bench_of(p), p.unit, p.start,
                                     why_undetermined(problem_, derivatives_, covariance_, k),
                                     recording_for(p)});
        for (std::size_t n = 0; n < free_.size(); ++n)
          if (n != k && free_[n] && is_alike(covariance_, k, n)) given_[n] = p.key;
      }
      solution_.u = problem_.with_frictions_of_inertia(true, solution_.u);
      for (const std::size_t k : held) {
        free_[k] = false;
        solution_.u[static_cast<Index>(k)] = 0.0;
      }
      solution_.u = problem_.with_frictions_of_inertia(false, solution_.u);
      if (base::Problems problems = settle(); !problems.empty()) return problems;
    }
  }

  /// Holds at 0 the frictions whose best value is not above it. Their upper bounds follow from the linear problem.
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
                             given_[k],
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
      const base::Result<UnknownBounds> bounds = bounds_of(problem_, solution_, covariance_, free_, k);
      if (!bounds) return bounds.problems();
      const double u = solution_.u[static_cast<Index>(k)];
      out_.values.push_back({p.key,
                             bench_of(p),
                             p.unit,
                             p.start,
                             {p.value(u), p.value(bounds->low), p.value(bounds->high)},
                             given_[k],
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
        analysis::FitColumn column{model.bench().name,
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
  std::vector<std::string> given_;  ///< FittedValue::given of each unknown
  FitSolution solution_{};
  Eigen::MatrixXd derivatives_;
  FitCovariance covariance_;
  double change_ = 0.0;  ///< of the columns' noise by the last search
  Fit out_;
};

}  // namespace

namespace {

base::Result<Fit> fit_once(const FitRequest& request) {
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

/// Begins the shifts of the recordings where a fit has found them. Returns whether one moved so far that other rows lie within
/// the simulated time.
bool take_shifts(const Fit& found, FitRequest& request) {
  bool moved = false;
  for (FitBench& bench : request.benches)
    for (const analysis::FittedValue& v : found.values)
      if (v.key == "shift_s" && v.bench == bench.name) {
        moved = moved || std::fabs(v.value.value - bench.shift_s) > FitModel::margin_s(bench);
        bench.shift_s = v.value.value;
      }
  return moved;
}

}  // namespace

base::Result<Fit> fit(const FitRequest& request) {
  base::Result<Fit> found = fit_once(request);
  FitRequest again = request;
  for (int round = 0; round < 3 && found && take_shifts(*found, again); ++round) {
    const std::size_t before = found->simulations;
    found = fit_once(again);
    if (found) found->simulations += before;
  }
  return found;
}

}  // namespace batch
