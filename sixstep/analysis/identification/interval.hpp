// SPDX-License-Identifier: Apache-2.0
// A measured number with its uncertainty.
#pragma once

namespace sixstep::analysis {

/// A value, and bounds that contain the true value with a probability of 95 %. tests/analysis/identification/
/// counts over a thousand simulated recordings how often the bounds contain the true value.
struct Interval {
  double value = 0.0, low = 0.0, high = 0.0;

  bool holds(double x) const { return low <= x && x <= high; }
  double half_width() const { return (high - low) / 2.0; }
};

inline Interval around(double value, double half_width) {
  return {value, value - half_width, value + half_width};
}
inline Interval scaled(Interval x, double factor) {
  return factor < 0.0 ? Interval{x.value * factor, x.high * factor, x.low * factor}
                      : Interval{x.value * factor, x.low * factor, x.high * factor};
}

}  // namespace sixstep::analysis
