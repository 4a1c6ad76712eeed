// SPDX-License-Identifier: Apache-2.0
#include "batch/fit/fit_solver.hpp"

#include <cstddef>
#include <optional>
#include <unsupported/Eigen/NonLinearOptimization>
#include <utility>

namespace batch {

namespace {

/// The free unknowns of a problem, in the form that Eigen's method requires.
struct FreeUnknowns {
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  FitProblem& problem;
  const std::vector<bool>& free;
  Eigen::VectorXd all;
  std::vector<Eigen::Index> place{};  ///< index in `all` of each free unknown
  base::Problems problems{};

  int inputs() const { return static_cast<int>(place.size()); }
  int values() const { return static_cast<int>(problem.rows()); }

  Eigen::VectorXd with(const Eigen::VectorXd& x) const {
    Eigen::VectorXd u = all;
    for (std::size_t k = 0; k < place.size(); ++k) u[place[k]] = x[static_cast<Eigen::Index>(k)];
    return u;
  }
  int operator()(const Eigen::VectorXd& x, Eigen::VectorXd& out) {
    base::Result<Eigen::VectorXd> r = problem.residuals(with(x));
    if (r) {
      out = std::move(*r);
      return 0;
    }
    if (problem.stopped()) problems = r.problems();
    out = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(problem.rows()), 1e6);
    return problem.stopped() ? -1 : 0;
  }
  int df(const Eigen::VectorXd& x, Eigen::MatrixXd& out) {
    const base::Result<Eigen::MatrixXd> whole = problem.derivatives(with(x), free);
    if (!whole) {
      problems = whole.problems();
      return -1;
    }
    for (std::size_t k = 0; k < place.size(); ++k)
      out.col(static_cast<Eigen::Index>(k)) = whole->col(place[k]);
    return 0;
  }
};

bool reached(Eigen::LevenbergMarquardtSpace::Status status) {
  using enum Eigen::LevenbergMarquardtSpace::Status;
  return status == RelativeReductionTooSmall || status == RelativeErrorTooSmall ||
         status == CosinusTooSmall || status == RelativeErrorAndReductionTooSmall || status == FtolTooSmall ||
         status == XtolTooSmall || status == GtolTooSmall;
}

}  // namespace

base::Result<FitSolution> solve(FitProblem& problem, const Eigen::VectorXd& u, const std::vector<bool>& free,
                                int evaluations) {
  FreeUnknowns unknowns{problem, free, u};
  for (std::size_t k = 0; k < free.size(); ++k)
    if (free[k]) unknowns.place.push_back(static_cast<Eigen::Index>(k));
  base::Result<Eigen::VectorXd> start = problem.residuals(u);
  if (!start) return start.problems();
  if (unknowns.place.empty()) return FitSolution{u, std::move(*start), true};
  Eigen::VectorXd x(static_cast<Eigen::Index>(unknowns.place.size()));
  for (std::size_t k = 0; k < unknowns.place.size(); ++k)
    x[static_cast<Eigen::Index>(k)] = u[unknowns.place[k]];
  Eigen::LevenbergMarquardt<FreeUnknowns> method(unknowns);
  method.parameters.ftol = 1e-6;  // a change of 0.03 standard deviations at a thousand rows
  method.parameters.xtol = 1e-6;
  method.parameters.maxfev = evaluations;
  // Limits the first step in u, whose scale is similar for all unknowns: it changes a constant by at most a
  // third.
  method.parameters.factor = 0.3;
  method.useExternalScaling = true;
  method.diag = Eigen::VectorXd::Ones(x.size());
  const auto status = method.minimize(x);
  if (!unknowns.problems.empty()) return unknowns.problems;
  const Eigen::VectorXd found = unknowns.with(x);
  base::Result<Eigen::VectorXd> residuals = problem.residuals(found);
  if (!residuals) return residuals.problems();
  return FitSolution{found, std::move(*residuals), reached(status)};
}

}  // namespace batch
