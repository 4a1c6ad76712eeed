// SPDX-License-Identifier: Apache-2.0
// Solves small symmetric systems: normal equations and covariances.
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace sixstep::analysis {

/// A symmetric matrix that stores all n x n values. Fill both halves, or fill the lower half and call
/// mirror().
class Symmetric {
 public:
  explicit Symmetric(std::size_t size = 0) : size_(size), values_(size * size) {}

  std::size_t size() const { return size_; }
  double& at(std::size_t row, std::size_t column) { return values_[row * size_ + column]; }
  double at(std::size_t row, std::size_t column) const { return values_[row * size_ + column]; }
  void mirror() {
    for (std::size_t i = 0; i < size_; ++i)
      for (std::size_t k = 0; k < i; ++k) at(k, i) = at(i, k);
  }
  /// The quadratic form weights' M weights.
  double square(std::span<const double> weights) const;

 private:
  std::size_t size_;
  std::vector<double> values_;
};

/// Factors M = L L'. Each unknown is scaled by its own diagonal element, because unknowns may differ by many
/// powers of ten.
class Cholesky {
 public:
  /// Empty if the matrix is not positive definite within rounding.
  static std::optional<Cholesky> of(const Symmetric& matrix);

  std::vector<double> solve(std::span<const double> right) const;
  Symmetric inverse() const;
  double log_determinant() const;

 private:
  Symmetric lower_;
  std::vector<double> scale_;
};

/// Normal equations of least squares; rows are added one by one.
class NormalEquations {
 public:
  explicit NormalEquations(std::size_t unknowns) : left_(unknowns), right_(unknowns) {}

  void add(std::span<const double> row, double value, double weight = 1.0);

  std::size_t rows() const { return rows_; }
  Symmetric left() const;
  const std::vector<double>& right() const { return right_; }
  /// Weighted sum of the squared values: the residual if all unknowns are 0.
  double square() const { return square_; }

 private:
  Symmetric left_;  // the lower half
  std::vector<double> right_;
  double square_ = 0.0;
  std::size_t rows_ = 0;
};

struct Solution {
  std::vector<double> unknowns;
  Symmetric cofactors;  ///< the covariance if every row's variance is the inverse of its weight
  double residual_square = 0.0;
};

/// Empty if the rows do not determine the unknowns.
std::optional<Solution> solution_of(const NormalEquations& equations);

}  // namespace sixstep::analysis
