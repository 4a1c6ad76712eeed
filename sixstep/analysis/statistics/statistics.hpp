// SPDX-License-Identifier: Apache-2.0
// What many values of one figure say together.
#pragma once
#include <cstddef>
#include <optional>
#include <vector>

namespace sixstep::analysis {

/// Values are added in the order of the runs, so that the sums have the same bits however many threads there
/// were. A figure without a value (NaN) is counted apart; one that never comes (infinity) is a value, and
/// then mean and deviation are not.
class Statistics {
 public:
  void add(double x);

  std::size_t count() const { return values_.size(); }  ///< of values
  std::size_t missing() const { return missing_; }
  std::optional<double> mean() const;
  /// Of the population these are a sample of: divided by count - 1; needs two values.
  std::optional<double> standard_deviation() const;
  /// The order statistic x_(k), k = ceil(p count) and at least 1: the least value that at least the part p of
  /// all values do not exceed. A value that occurred, nothing interpolated. 0 is the least, 1 the greatest.
  std::optional<double> quantile(double p) const;
  /// The value in the middle; of an even count, which has two, their mean.
  std::optional<double> median() const;
  std::optional<double> min() const { return quantile(0.0); }
  std::optional<double> max() const { return quantile(1.0); }

 private:
  bool all_finite() const;
  std::vector<double> values_;
  std::size_t missing_ = 0;
};

}  // namespace sixstep::analysis
