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

/// A column's noise falls by at most this factor at once. Otherwise the first column that the model meets would outweigh
/// the others and hold the search in a narrow valley.
constexpr double least_factor = 0.3;

/// Least and widest step of an unknown for a derivative, and the first one. A step moves a column at least by this part of
/// its span.
constexpr double least_step = 1e-6, widest_step = 1e-2, first_step = 1e-3, least_move = 1e-5;

/// Width of a converter's steps: the least difference of two values, if all differences are multiples of it. 0 if there
/// are more than 4096 steps, which no fit notices.
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
  difference_.assign(parameters_.size(), first_step);
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

Eigen::VectorXd FitProblem::with_frictions_of_inertia(bool of_inertia, const Eigen::VectorXd& u) {
  const double inertia = inertia_factor(parameters_, span_of(u));
  Eigen::VectorXd out = u;
  for (std::size_t k = 0; k < parameters_.size(); ++k) {
    FitParameter& p = parameters_[k];
    if (!p.positive || p.of_inertia == of_inertia) continue;
    const double value = p.value(u[static_cast<Eigen::Index>(k)]) * (of_inertia ? 1.0 / inertia : inertia);
    out[static_cast<Eigen::Index>(k)] = (value - p.start) / p.scale;
    p.of_inertia = of_inertia;
  }
  return out;
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

Eigen::VectorXd FitProblem::moved(const Eigen::VectorXd& u, const std::vector<bool>& free, std::size_t k,
                                  double by) const {
  Eigen::VectorXd out = u;
  out[static_cast<Eigen::Index>(k)] += by;
  if (!is_inertia(parameters_[k])) return out;
  for (std::size_t n = 0; n < parameters_.size(); ++n) {
    const FitParameter& p = parameters_[n];
    const auto at = static_cast<Eigen::Index>(n);
    if (free[n] && p.positive && !p.of_inertia) out[at] = (p.value(u[at]) * std::exp(by) - p.start) / p.scale;
  }
  return out;
}

void FitProblem::part_inertia(const Eigen::VectorXd& u, const std::vector<bool>& free,
                              Eigen::MatrixXd& derivatives) const {
  for (std::size_t k = 0; k < parameters_.size(); ++k) {
    if (!free[k] || !is_inertia(parameters_[k])) continue;
    for (std::size_t n = 0; n < parameters_.size(); ++n) {
      const FitParameter& p = parameters_[n];
      const auto at = static_cast<Eigen::Index>(n);
      if (free[n] && p.positive && !p.of_inertia)
        derivatives.col(static_cast<Eigen::Index>(k)) -= p.value(u[at]) / p.scale * derivatives.col(at);
    }
  }
}

void FitProblem::adapt_steps(const std::vector<bool>& free, const Eigen::MatrixXd& derivatives) {
  for (std::size_t k = 0; k < parameters_.size(); ++k) {
    if (!free[k]) continue;
    double sum = 0.0;
    for (std::size_t n = 0; n < cells(); ++n) {
      const double x = derivatives(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(k)) *
                       std::min(1.0, noise_[group_[n]] / (least_move * span_[group_[n]]));
      sum += x * x;
    }
    const double rms = std::sqrt(sum / static_cast<double>(std::max<std::size_t>(cells(), 1)));
    difference_[k] = std::clamp(1.0 / std::max(rms, 1e-9), least_step, widest_step);
  }
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
    const double step = difference_[k];
    // A friction at 0 has one side only.
    const bool both = !parameters_[k].positive || parameters_[k].value(u[column] - step) > 0.0;
    const base::Result<Eigen::VectorXd> high = model(moved(u, free, k, step)),
                                        low = model(both ? moved(u, free, k, -step) : u);
    if (!high)
      problems[k] = high.problems();
    else if (!low)
      problems[k] = low.problems();
    else
      out.col(column).head(high->size()) = (*low - *high) / (both ? 2.0 * step : step);
  });
  for (std::size_t k = 0; k < count; ++k) {
    if (!problems[k].empty()) return problems[k];
    if (free[k]) simulations_ += 2;
  }
  for (std::size_t n = 0; n < cells(); ++n) out.row(static_cast<Eigen::Index>(n)) /= noise_[group_[n]];
  adapt_steps(free, out);
  part_inertia(u, free, out);
  for (std::size_t k = 0; k < count; ++k)
    if (free[k]) out(static_cast<Eigen::Index>(cells() + k), static_cast<Eigen::Index>(k)) = 1.0;
  return out;
}

double FitProblem::take_noise(const Eigen::VectorXd& residuals, std::size_t free, double least) {
  std::vector<double> squares(noise_.size());
  std::vector<std::size_t> count(noise_.size());
  for (std::size_t n = 0; n < cells(); ++n) {
    const double r = residuals[static_cast<Eigen::Index>(n)];
    squares[group_[n]] += r * r;
    ++count[group_[n]];
  }
  // The free parameters take one degree of freedom each, in proportion to a column's rows.
  const double taken = std::min(0.5, static_cast<double>(free) / static_cast<double>(cells()));
  double change = 0.0;
  for (std::size_t g = 0; g < noise_.size(); ++g) {
    if (count[g] == 0) continue;
    const double factor = std::sqrt(squares[g] / (static_cast<double>(count[g]) * (1.0 - taken)));
    const double noise = std::max({noise_[g] * factor, noise_[g] * least_factor, least * span_[g]});
    change = std::max(change, std::fabs(noise / noise_[g] - 1.0));
    noise_[g] = noise;
  }
  return change;
}

}  // namespace batch
