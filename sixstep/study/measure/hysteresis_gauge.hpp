// SPDX-License-Identifier: Apache-2.0
// A HysteresisGauge measures how well an event hysteresis keeps its band: excess above the upper limit,
// shortfall below the lower one outside of the recovery from a commutation or a new reference, and the
// switching frequency.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "sixstep/study/measure/signals.hpp"
#include "sixstep/study/measure/window.hpp"

namespace sixstep::study {

/// NaN, which meets no requirement, where no comparator was ever armed.
struct HysteresisFigures {
  double excess_A = std::numeric_limits<double>::quiet_NaN(), deficit_A = excess_A;
};

class HysteresisGauge {
 public:
  explicit HysteresisGauge(const Window& window = {}) : window_(window) {}

  /// One segment, up to its fraction s, by every armed comparator. Outside of the window it is followed too:
  /// what is excused at the window's begin hangs on what was before.
  void segment(const SegmentView& g, double s);
  const HysteresisFigures& figures() const { return figures_; }

 private:
  /// What one comparator has seen last. A new reference excuses both limits until the current is back in the
  /// band, a sector edge only the lower one: the mean of two phases drops there, it has no reason to rise.
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
