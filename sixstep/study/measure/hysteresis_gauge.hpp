// SPDX-License-Identifier: Apache-2.0
// Measures how well an event hysteresis keeps its band: the excess above the upper limit, and the shortfall
// below the lower limit. The recovery from a commutation or a new reference does not count.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "sixstep/study/measure/signals.hpp"
#include "sixstep/study/measure/window.hpp"

namespace sixstep::study {

/// NaN if no comparator was ever armed; NaN meets no requirement.
struct HysteresisFigures {
  double excess_A = std::numeric_limits<double>::quiet_NaN(), deficit_A = excess_A;
};

class HysteresisGauge {
 public:
  explicit HysteresisGauge(const Window& window = {}) : window_(window) {}

  /// Adds one segment, up to its fraction s, for every armed comparator. Segments outside of the window are
  /// followed as well, because they decide which deviations are excused at the window's beginning.
  void segment(const SegmentView& g, double s);
  const HysteresisFigures& figures() const { return figures_; }

 private:
  /// The last state of one comparator. A new reference excuses deviations from both limits until the current
  /// is back in the band. A sector edge excuses only deviations below the lower limit, because the mean of
  /// two phase currents drops at a commutation and never rises.
  struct Watched {
    int sector = -1;
    double key = 0.0;  ///< upper limit with the sign of the reference
    bool excused_above = true, excused_below = true;
  };
  struct Limits {
    double lower, upper, key;
  };
  void part(Watched& watched, const SegmentView& g, const Series& c, const Limits& limits, double s);

  Window window_;
  HysteresisFigures figures_;
  Watched watched_[2]{};
};

}  // namespace sixstep::study
