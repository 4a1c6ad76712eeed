// SPDX-License-Identifier: Apache-2.0
// Figures from the largest and the smallest value in a window. A part of the signal whose bounds lie within
// the extremes so far is not searched.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "sixstep/series/extremes.hpp"
#include "sixstep/study/measure/step_gauges.hpp"

namespace sixstep::study {

using Extremes = series::Extremes<double>;

struct Maximum {
  bool high() const { return true; }
  bool low() const { return false; }
  void begin(double) {}
  double read(const Extremes& seen) const { return seen.high; }
};

struct Minimum {
  bool high() const { return false; }
  bool low() const { return true; }
  void begin(double) {}
  double read(const Extremes& seen) const { return seen.low; }
};

struct PeakToPeak {
  bool high() const { return true; }
  bool low() const { return true; }
  void begin(double) {}
  double read(const Extremes& seen) const { return seen.high - seen.low; }
};

struct LargestError {
  double level = 0.0;
  bool high() const { return true; }
  bool low() const { return true; }
  void begin(double) {}
  double read(const Extremes& seen) const { return std::max(seen.high - level, level - seen.low); }
};

struct Overshoot {
  Step step;
  bool high() const { return step.sign() > 0; }
  bool low() const { return !high(); }
  void begin(double first) { step.begin(first); }
  double read(const Extremes& seen) const {
    return std::max(0.0, high() ? seen.high - step.level : step.level - seen.low);
  }
};

template <class Reading>
class ExtremeGauge {
 public:
  explicit ExtremeGauge(const Reading& reading) : reading_(reading) {}

  /// True if a signal within these bounds cannot change the result.
  bool holds(const Extremes& bounds) const {
    return (!reading_.high() || bounds.high <= seen_.high) && (!reading_.low() || bounds.low >= seen_.low);
  }
  void part(const Series& c, int degree, double, double) {
    reading_.begin(c[0]);
    // A quick bound first, because most segments cannot change the extremes.
    const double reach = series::magnitude_of(c, degree) - std::fabs(c[0]);
    if (holds({c[0] - reach, c[0] + reach})) return;
    const Extremes range = series::extremes(c, degree);
    widen(range.low, range.high);
  }
  void sample(double, double value) {
    reading_.begin(value);
    widen(value, value);
  }
  double value(double) const { return reading_.read(seen_); }

 private:
  void widen(double low, double high) {
    seen_.high = std::max(seen_.high, high);
    seen_.low = std::min(seen_.low, low);
  }

  Reading reading_;
  Extremes seen_{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
};

}  // namespace sixstep::study
