// SPDX-License-Identifier: Apache-2.0
#include "batch/fit/fit_bounds.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "sixstep/analysis/identification/distributions.hpp"
#include "sixstep/base/angle.hpp"

namespace batch {

namespace {

using Index = Eigen::Index;

/// Growth of the sum of squares at the parabola's bound, relative to the parabola's, from which on the profile is searched.
constexpr double most_curved = 4.0;

/// Pairs of points around a solution.
constexpr int pairs_of_points = 16;

/// Part of the variance by roughness from which on the profile is not searched.
constexpr double most_rough = 0.05;

/// Rows of one column of one bench, in the order of time.
std::vector<Index> rows_of(const FitProblem& problem, std::size_t group) {
  std::vector<Index> rows;
  for (std::size_t n = 0; n < problem.cells(); ++n)
    if (problem.group_of(n) == group) rows.push_back(static_cast<Index>(n));
  return rows;
}

double correlation_at(const Eigen::VectorXd& r, const std::vector<Index>& rows, std::size_t lag) {
  double product = 0.0, square = 0.0;
  for (std::size_t n = 0; n < rows.size(); ++n) {
    square += r[rows[n]] * r[rows[n]];
    if (n + lag < rows.size()) product += r[rows[n]] * r[rows[n + lag]];
  }
  return square > 0 ? product / square : 0.0;
}

/// Number of lags in the sum: twice the lag after which five consecutive correlations are within the noise.
/// 0: white noise.
std::size_t lags_of(const Eigen::VectorXd& r, const std::vector<Index>& rows) {
  const double noise = 2.0 / std::sqrt(static_cast<double>(std::max<std::size_t>(rows.size(), 4)));
  const std::size_t most = rows.size() / 8;
  std::size_t quiet = 0, lag = 1;
  for (; lag <= most && quiet < 5; ++lag)
    quiet = std::fabs(correlation_at(r, rows, lag)) < noise ? quiet + 1 : 0;
  const std::size_t last = lag - 1 - std::min<std::size_t>(quiet, lag - 1);  // the last lag above the noise
  return std::min(2 * last, most);
}

/// Covariance of J' r (J: derivatives, r: residuals): the sum over the lags of the products of the scores.
Eigen::MatrixXd scores_of(const Eigen::MatrixXd& j, const Eigen::VectorXd& r, const std::vector<Index>& rows,
                          std::size_t lags) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(j.cols(), j.cols());
  for (std::size_t lag = 0; lag <= lags; ++lag) {
    const double weight = 1.0 - static_cast<double>(lag) / static_cast<double>(lags + 1);
    for (std::size_t n = 0; n + lag < rows.size(); ++n) {
      const double product = weight * r[rows[n]] * r[rows[n + lag]];
      const Eigen::MatrixXd term = product * j.row(rows[n]).transpose() * j.row(rows[n + lag]);
      sum += lag == 0 ? term : Eigen::MatrixXd(term + term.transpose());
    }
  }
  return sum;
}

/// Parts of a converter's step in which all rows have one error, also if they repeat from period to period.
constexpr double parts_of_a_step = 4.0;

/// Covariance of J' r that the steps of a converter cause. If the noise is below a step, rows within one step
/// have the same error, which no residual shows. Its variance is step^2/12 without noise. Noise reduces the
/// variance like the first harmonic of the steps' sawtooth.
Eigen::MatrixXd steps_of(const FitProblem& problem, const Eigen::MatrixXd& j, const Eigen::VectorXd& r,
                         const std::vector<Index>& rows, std::size_t group) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(j.cols(), j.cols());
  const double step = problem.step(group), steady = step * step / 12.0;
  if (!(step > 0)) return sum;
  const double noise = std::max(0.0, 1.0 - steady);  // variance of the noise before the converter
  const double variance = steady * std::exp(-4.0 * base::pi * base::pi * noise / (step * step));
  if (variance < 1e-6) return sum;
  std::map<long long, Eigen::VectorXd> together;
  for (const Index row : rows) {
    const double model = problem.recorded(static_cast<std::size_t>(row)) - r[row];
    auto [at, first] = together.try_emplace(std::llround(parts_of_a_step * model / step));
    if (first) at->second = Eigen::VectorXd::Zero(j.cols());
    at->second += j.row(row).transpose();
  }
  for (const auto& [part, scores] : together) sum += variance * scores * scores.transpose();
  return sum;
}

/// The columns of J for the free unknowns.
Eigen::MatrixXd free_columns(const Eigen::MatrixXd& j, const std::vector<bool>& free) {
  Eigen::MatrixXd out(j.rows(), static_cast<Index>(std::count(free.begin(), free.end(), true)));
  for (Index k = 0, at = 0; k < j.cols(); ++k)
    if (free[static_cast<std::size_t>(k)]) out.col(at++) = j.col(k);
  return out;
}

Eigen::MatrixXd spread_out(const Eigen::MatrixXd& part, const std::vector<bool>& free) {
  const auto count = static_cast<Index>(free.size());
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(count, count);
  Index row = 0;
  for (Index i = 0; i < count; ++i) {
    if (!free[static_cast<std::size_t>(i)]) continue;
    Index column = 0;
    for (Index k = 0; k < count; ++k)
      if (free[static_cast<std::size_t>(k)]) out(i, k) = part(row, column++);
    ++row;
  }
  return out;
}

/// Inverse of J'J, which the rows of the start values make positive definite. Each column is first scaled to
/// length 1.
Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& j) {
  const Eigen::VectorXd inverse_length = j.colwise().norm().cwiseInverse();
  const Eigen::MatrixXd scaled = j * inverse_length.asDiagonal();
  const Eigen::MatrixXd inverse =
      (scaled.transpose() * scaled).llt().solve(Eigen::MatrixXd::Identity(j.cols(), j.cols()));
  return inverse_length.asDiagonal() * inverse * inverse_length.asDiagonal();
}

}  // namespace

double lag_correlation(const FitProblem& problem, const Eigen::VectorXd& residuals, std::size_t group) {
  return correlation_at(residuals, rows_of(problem, group), 1);
}

FitCovariance covariance_of(const FitProblem& problem, const Eigen::MatrixXd& derivatives,
                            const Eigen::VectorXd& residuals, const std::vector<bool>& free) {
  const Eigen::MatrixXd j = free_columns(derivatives, free);
  const Eigen::MatrixXd inverse = inverse_of(j);
  // The rows of the start values are independent of each other.
  const Eigen::MatrixXd of_start = j.bottomRows(j.rows() - static_cast<Index>(problem.cells()));
  Eigen::MatrixXd scores = of_start.transpose() * of_start;
  double independent = 0.0;
  bool white = true;
  for (std::size_t g = 0; g < problem.groups(); ++g) {
    const std::vector<Index> rows = rows_of(problem, g);
    const std::size_t lags = lags_of(residuals, rows);
    const Eigen::MatrixXd by_steps = steps_of(problem, j, residuals, rows, g);
    white = white && lags == 0 && by_steps.isZero();
    scores += scores_of(j, residuals, rows, lags) + by_steps;
    double sum = 1.0;
    for (std::size_t lag = 1; lag <= lags; ++lag)
      sum += 2.0 * std::max(0.0, correlation_at(residuals, rows, lag));
    independent += static_cast<double>(rows.size()) / sum;
  }
  Eigen::MatrixXd without_start = j;
  without_start.bottomRows(of_start.rows()) *= 0.1;
  FitCovariance out;
  out.of_white_noise = spread_out(inverse, free);
  out.growth_without_start = spread_out(inverse_of(without_start), free)
                                 .diagonal()
                                 .cwiseQuotient(out.of_white_noise.diagonal().cwiseMax(1e-300));
  out.roughness = Eigen::MatrixXd::Zero(out.of_white_noise.rows(), out.of_white_noise.cols());
  out.covariance = white ? out.of_white_noise : spread_out(inverse * scores * inverse, free);
  out.degrees_of_freedom = std::max(1.0, independent - static_cast<double>(j.cols()));
  return out;
}

base::Result<Estimates> estimates_around(FitProblem& problem, const FitSolution& solution,
                                         const Eigen::MatrixXd& derivatives, const FitCovariance& covariance,
                                         const std::vector<bool>& determined) {
  const Index count = solution.u.size();
  Eigen::MatrixXd moved = covariance.covariance;
  for (Index k = 0; k < count; ++k)
    if (!determined[static_cast<std::size_t>(k)]) {
      moved.row(k).setZero();
      moved.col(k).setZero();
    }
  // Each pair of points is opposite, and moves along all axes of the ellipsoid of one standard deviation at once: a move along
  // one axis may leave every sampling instant of the firmware on the same side of its event.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(moved);
  const Eigen::MatrixXd root =
      axes.eigenvectors() * axes.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
  Estimates out{Eigen::VectorXd::Zero(count), Eigen::MatrixXd::Zero(count, count)};
  std::uint64_t bits = 1;
  for (int pair = 0; pair < pairs_of_points; ++pair) {
    Eigen::VectorXd direction(count);
    for (Index k = 0; k < count; ++k) {
      bits = bits * 6364136223846793005ULL +
             1442695040888963407ULL;  // Knuth, The Art of Computer Programming 3.3.4
      direction[k] = (bits >> 63) != 0 ? 1.0 : -1.0;
    }
    const Eigen::VectorXd step = root * direction;
    Eigen::VectorXd estimate[2];
    for (const int side : {0, 1}) {
      const Eigen::VectorXd u = solution.u + (side == 0 ? 1.0 : -1.0) * step;
      const base::Result<Eigen::VectorXd> r = problem.residuals(u);
      if (!r) return r.problems();
      estimate[side] = u - covariance.of_white_noise * (derivatives.transpose() * *r);
    }
    const Eigen::VectorXd odd = (estimate[0] - estimate[1]) / 2.0;
    out.mean += (estimate[0] + estimate[1]) / (2.0 * pairs_of_points);
    out.spread += 2.0 * odd * odd.transpose() / pairs_of_points;
  }
  return out;
}

base::Result<UnknownBounds> bounds_of(FitProblem& problem, const FitSolution& solution,
                                      const FitCovariance& covariance, const std::vector<bool>& free,
                                      std::size_t k) {
  const auto at = static_cast<Index>(k);
  const double variance = covariance.covariance(at, at), white = covariance.of_white_noise(at, at);
  const double width = analysis::student_95(covariance.degrees_of_freedom) * std::sqrt(variance);
  // Increase of the sum of squares at the bounds, relative to the variance of one residual.
  const double growth = width * width / white;
  UnknownBounds out{solution.u[at] - width, solution.u[at] + width, false};
  if (covariance.roughness(at, at) > most_rough * variance)
    return out;  // no parabola fits a rough sum of squares
  const double least = solution.square();
  const Eigen::VectorXd along =
      covariance.of_white_noise.col(at) / white;  // best change of the other unknowns per change of k
  std::vector<bool> others = free;
  others[k] = false;
  for (double* const bound : {&out.low, &out.high}) {
    double step = *bound - solution.u[at];
    const base::Result<Eigen::VectorXd> there = problem.residuals(solution.u + step * along);
    const double near = there ? (there->squaredNorm() - least) / growth : most_curved;
    if (near > 1.0 / most_curved &&
        near < most_curved) {  // nearly parabolic: the parabola through this point
      step /= std::sqrt(std::clamp(near, 0.75, 1.25) == near ? 1.0 : near);
      *bound = solution.u[at] + step;
      continue;
    }
    out.by_profile = true;
    for (int trial = 0; trial < 4; ++trial) {
      const base::Result<FitSolution> best = solve(problem, solution.u + step * along, others, 8);
      if (!best && problem.stopped()) return best.problems();
      const double grown = best ? (best->square() - least) / growth : most_curved;
      if (std::fabs(grown - 1.0) < 0.1) break;
      step *= std::clamp(1.0 / std::sqrt(std::max(grown, 0.01)), 0.3, 3.0);
    }
    *bound = solution.u[at] + step;
  }
  return out;
}

}  // namespace batch
