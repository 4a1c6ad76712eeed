// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/statistics/statistics.hpp"

#include <algorithm>
#include <cmath>

namespace sixstep::analysis {

void Statistics::add(double x) {
  if (std::isnan(x))
    ++missing_;
  else
    values_.push_back(x);
}

bool Statistics::all_finite() const {
  return std::all_of(values_.begin(), values_.end(), [](double x) { return std::isfinite(x); });
}

std::optional<double> Statistics::mean() const {
  if (values_.empty() || !all_finite()) return {};
  // Differences to the first value keep the digits of figures that hardly differ.
  double sum = 0.0;
  for (const double x : values_) sum += x - values_[0];
  return values_[0] + sum / static_cast<double>(values_.size());
}

std::optional<double> Statistics::standard_deviation() const {
  const std::optional<double> centre = mean();
  if (!centre || values_.size() < 2) return {};
  double squares = 0.0;
  for (const double x : values_) squares += (x - *centre) * (x - *centre);
  return std::sqrt(squares / static_cast<double>(values_.size() - 1));
}

std::optional<double> Statistics::median() const {
  if (values_.empty()) return {};
  std::vector<double> values = values_;
  const auto upper = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), upper, values.end());
  if (values.size() % 2 == 1) return *upper;
  // Halves are added, because the sum of the two values may exceed the largest double.
  return *std::max_element(values.begin(), upper) / 2 + *upper / 2;
}

std::optional<double> Statistics::quantile(double p) const {
  if (values_.empty()) return {};
  const auto count = static_cast<double>(values_.size());
  const double k = std::clamp(std::ceil(p * count), 1.0, count);
  std::vector<double> values = values_;
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(k) - 1;
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace sixstep::analysis
