// SPDX-License-Identifier: Apache-2.0
// Statistics of many values of one figure.
#pragma once
#include <cstddef>
#include <optional>
#include <vector>

namespace sixstep::analysis {

/// Values are added in the order of the runs: the sums then have the same bits with any number of threads.
/// NaN (a figure without a value) is counted separately. Infinity (the event never occurs) counts as a value;
/// mean and deviation are then empty.
class Statistics {
 public:
  void add(double x);

  std::size_t count() const { return values_.size(); }  ///< number of values
  std::size_t missing() const { return missing_; }
  std::optional<double> mean() const;
  /// Estimated standard deviation of the population, the sum of squares divided by count - 1. Requires two
  /// values.
  std::optional<double> standard_deviation() const;
  /// The order statistic x_(k), with k = ceil(p count) and at least 1: the smallest value x for which at
  /// least the fraction p of all values is at most x. It is not interpolated. p = 0 gives the least value, p
  /// = 1 the greatest.
  std::optional<double> quantile(double p) const;
  /// The middle value; for an even count the mean of the two middle values.
  std::optional<double> median() const;
  std::optional<double> min() const { return quantile(0.0); }
  std::optional<double> max() const { return quantile(1.0); }

 private:
  bool all_finite() const;
  std::vector<double> values_;
  std::size_t missing_ = 0;
};

}  // namespace sixstep::analysis
