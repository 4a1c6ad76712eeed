// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/identification/symmetric.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/base/elementary.hpp"

namespace sixstep::analysis {

double Symmetric::square(std::span<const double> weights) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < size_; ++i)
    for (std::size_t k = 0; k < size_; ++k) sum += weights[i] * at(i, k) * weights[k];
  return sum;
}

std::optional<Cholesky> Cholesky::of(const Symmetric& matrix) {
  constexpr double least_pivot = 1e-13;  // relative to 1: a smaller pivot is only rounding, and no row
                                         // determines its direction
  const std::size_t n = matrix.size();
  Cholesky out;
  out.lower_ = Symmetric(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (!(matrix.at(i, i) > 0.0) || !std::isfinite(matrix.at(i, i))) return {};
    out.scale_.push_back(1.0 / std::sqrt(matrix.at(i, i)));
  }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k <= i; ++k) {
      double sum = matrix.at(i, k) * out.scale_[i] * out.scale_[k];
      for (std::size_t m = 0; m < k; ++m) sum -= out.lower_.at(i, m) * out.lower_.at(k, m);
      if (i == k && !(sum > least_pivot)) return {};
      out.lower_.at(i, k) = i == k ? std::sqrt(sum) : sum / out.lower_.at(k, k);
    }
  return out;
}

std::vector<double> Cholesky::solve(std::span<const double> right) const {
  const std::size_t n = scale_.size();
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i) {
    double sum = right[i] * scale_[i];
    for (std::size_t k = 0; k < i; ++k) sum -= lower_.at(i, k) * x[k];
    x[i] = sum / lower_.at(i, i);
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) x[i] -= lower_.at(k, i) * x[k];
    x[i] /= lower_.at(i, i);
  }
  for (std::size_t i = 0; i < n; ++i) x[i] *= scale_[i];
  return x;
}

Symmetric Cholesky::inverse() const {
  const std::size_t n = scale_.size();
  Symmetric out(n);
  std::vector<double> unit(n);
  for (std::size_t k = 0; k < n; ++k) {
    std::fill(unit.begin(), unit.end(), 0.0);
    unit[k] = 1.0;
    const std::vector<double> column = solve(unit);
    for (std::size_t i = 0; i < n; ++i) out.at(i, k) = column[i];
  }
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < i; ++k) out.at(i, k) = out.at(k, i) = 0.5 * (out.at(i, k) + out.at(k, i));
  return out;
}

double Cholesky::log_determinant() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < scale_.size(); ++i) sum += 2.0 * base::log(lower_.at(i, i) / scale_[i]);
  return sum;
}

void NormalEquations::add(std::span<const double> row, double value, double weight) {
  for (std::size_t i = 0; i < row.size(); ++i) {
    const double weighted = row[i] * weight;
    if (weighted == 0.0) continue;
    for (std::size_t k = 0; k <= i; ++k) left_.at(i, k) += weighted * row[k];
    right_[i] += weighted * value;
  }
  square_ += weight * value * value;
  ++rows_;
}

Symmetric NormalEquations::left() const {
  Symmetric out = left_;
  out.mirror();
  return out;
}

std::optional<Solution> solution_of(const NormalEquations& equations) {
  const std::optional<Cholesky> factors = Cholesky::of(equations.left());
  if (!factors) return {};
  Solution out{factors->solve(equations.right()), factors->inverse(), equations.square()};
  for (std::size_t n = 0; n < out.unknowns.size(); ++n)
    out.residual_square -= out.unknowns[n] * equations.right()[n];
  out.residual_square = std::max(out.residual_square, 0.0);
  return out;
}

}  // namespace sixstep::analysis
