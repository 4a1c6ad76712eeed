// SPDX-License-Identifier: Apache-2.0
#include "batch/fit/fit_problem.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace batch {

namespace {

std::span<const double> span_of(const Eigen::VectorXd& u) {
  return {u.data(), static_cast<std::size_t>(u.size())};
}

/// Least noise of a column, as a fraction of its span. A recording without noise comes from a simulation.
constexpr double least_noise = 1e-6;

/// Width of a converter's steps: the least difference of two values, if all differences are multiples of it.
/// 0 if there are more than 4096 steps, because such small steps do not affect a fit.
double step_of(std::vector<double> values) {
  values.erase(std::remove_if(values.begin(), values.end(), [](double x) { return !(x - x == 0.0); }),
               values.end());
  std::sort(values.begin(), values.end());
  if (values.size() < 2) return 0.0;
  const double span = values.back() - values.front(), least = span / 4096.0;
  double step = span;
  for (std::size_t n = 1; n < values.size(); ++n)
    if (const double gap = values[n] - values[n - 1]; gap > 0.1 * least) step = std::min(step, gap);
  if (!(step > least)) return 0.0;
  for (std::size_t n = 1; n < values.size(); ++n) {
    const double steps = (values[n] - values[n - 1]) / step;
    if (std::fabs(steps - std::round(steps)) > 0.05) return 0.0;
  }
  return step;
}

base::Problem ended_early() { return {"fit", "", "was stopped", "run it again"}; }

}  // namespace

FitProblem::FitProblem(const FitRequest& request, std::vector<FitModel> models,
                       std::vector<FitParameter> parameters)
    : request_(request), models_(std::move(models)), parameters_(std::move(parameters)) {
  std::vector<double> low, high;
  for (const FitModel& model : models_) {
    const std::size_t before = low.size();
    low.resize(before + model.bench().log.columns.size() - 1, INFINITY);
    high.resize(low.size(), -INFINITY);
    for (const FitCell& cell : model.cells()) {
      double &least = low[before + cell.column - 1], &greatest = high[before + cell.column - 1];
      least = std::min(least, cell.value);
      greatest = std::max(greatest, cell.value);
    }
  }
  for (std::size_t g = 0; g < low.size(); ++g) span_.push_back(high[g] > low[g] ? high[g] - low[g] : 1.0);
  for (const FitModel& model : models_)
    for (std::size_t c = 1; c < model.bench().log.columns.size(); ++c)
      step_.push_back(step_of(model.bench().log.values[c]));
  noise_ = span_;
  use(1.0);
}

void FitProblem::use(double part) {
  counts_.clear();
  group_.clear();
  std::vector<double> values;
  std::size_t before = 0;
  for (const FitModel& model : models_) {
    counts_.push_back(model.cells_until(part));
    for (std::size_t n = 0; n < counts_.back(); ++n) {
      const FitCell& cell = model.cells()[n];
      group_.push_back(before + cell.column - 1);
      values.push_back(cell.value);
    }
    before += model.bench().log.columns.size() - 1;
  }
  recorded_ = Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

base::Result<Eigen::VectorXd> FitProblem::model(const Eigen::VectorXd& u) {
  Eigen::VectorXd out(static_cast<Eigen::Index>(cells()));
  Eigen::Index at = 0;
  for (std::size_t m = 0; m < models_.size(); ++m) {
    const base::Result<std::vector<double>> part = models_[m].values(parameters_, span_of(u), counts_[m]);
    if (!part) return part.problems();
    for (const double x : *part) out[at++] = x;
  }
  return out;
}

base::Result<Eigen::VectorXd> FitProblem::residuals(const Eigen::VectorXd& u) {
  stopped_ = stopped_ || (request_.keep_going && !request_.keep_going());
  if (stopped_) return ended_early();
  ++simulations_;
  base::Result<Eigen::VectorXd> values = model(u);
  if (!values) return values.problems();
  Eigen::VectorXd out(static_cast<Eigen::Index>(rows()));
  out.head(values->size()) = recorded_ - *values;
  for (std::size_t n = 0; n < cells(); ++n) out[static_cast<Eigen::Index>(n)] /= noise_[group_[n]];
  out.tail(u.size()) = u;
  return out;
}

base::Result<Eigen::MatrixXd> FitProblem::derivatives(const Eigen::VectorXd& u,
                                                      const std::vector<bool>& free) {
  stopped_ = stopped_ || (request_.keep_going && !request_.keep_going());
  if (stopped_) return ended_early();
  const std::size_t count = parameters_.size();
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows()), u.size());
  std::vector<base::Problems> problems(count);
  request_.for_each(count, [&](std::size_t k) {
    if (!free[k]) return;
    const auto column = static_cast<Eigen::Index>(k);
    // A friction at 0 can only increase.
    const double step = parameters_[k].step();
    Eigen::VectorXd above = u, below = u;
    above[column] += step;
    if (!parameters_[k].positive || parameters_[k].value(u[column] - step) > 0.0) below[column] -= step;
    const base::Result<Eigen::VectorXd> high = model(above), low = model(below);
    if (!high)
      problems[k] = high.problems();
    else if (!low)
      problems[k] = low.problems();
    else
      out.col(column).head(high->size()) = (*low - *high) / (above[column] - below[column]);
  });
  for (std::size_t k = 0; k < count; ++k) {
    if (!problems[k].empty()) return problems[k];
    if (free[k]) simulations_ += 2;
  }
  for (std::size_t n = 0; n < cells(); ++n) out.row(static_cast<Eigen::Index>(n)) /= noise_[group_[n]];
  for (std::size_t k = 0; k < count; ++k)
    if (free[k]) out(static_cast<Eigen::Index>(cells() + k), static_cast<Eigen::Index>(k)) = 1.0;
  return out;
}

double FitProblem::take_noise(const Eigen::VectorXd& residuals, std::size_t free) {
  std::vector<double> squares(noise_.size());
  std::vector<std::size_t> count(noise_.size());
  for (std::size_t n = 0; n < cells(); ++n) {
    const double r = residuals[static_cast<Eigen::Index>(n)];
    squares[group_[n]] += r * r;
    ++count[group_[n]];
  }
  // The free parameters use one degree of freedom each, distributed in proportion to a column's rows.
  const double taken = std::min(0.5, static_cast<double>(free) / static_cast<double>(cells()));
  double change = 0.0;
  for (std::size_t g = 0; g < noise_.size(); ++g) {
    if (count[g] == 0) continue;
    const double factor = std::sqrt(squares[g] / (static_cast<double>(count[g]) * (1.0 - taken)));
    const double noise = std::max(noise_[g] * factor, least_noise * span_[g]);
    change = std::max(change, std::fabs(noise / noise_[g] - 1.0));
    noise_[g] = noise;
  }
  return change;
}

}  // namespace batch
