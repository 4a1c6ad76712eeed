// SPDX-License-Identifier: Apache-2.0
// How far from its place the driven pair changes: the electrical angle of the rotor at each commutation, less the edge of the
// sector that lies there, in the direction of rotation; late is positive.
//
//   pair of sector k goes over to that of k +- 1      edge at 60 (k + 1) or 60 k degrees, and half a turn from it with a
//                                                     current the other way round
//
// Whatever tells the drive where the rotor is, this is what comes of it. A pair that jumps, or was off before, counts not.
#pragma once
#include <cmath>
#include <limits>

#include "sixstep/study/measure/signals.hpp"
#include "sixstep/study/measure/window.hpp"

namespace sixstep::study {

class CommutationGauge {
 public:
  explicit CommutationGauge(const Window& window) : window_(window) {}

  void segment(const SegmentView& g, double);
  /// deg, largest by size; NaN where no pair changed in the window.
  double worst_deg() const { return count_ > 0 ? worst_deg_ : std::numeric_limits<double>::quiet_NaN(); }
  double rms_deg() const {
    return count_ > 0 ? std::sqrt(squares_ / static_cast<double>(count_))
                      : std::numeric_limits<double>::quiet_NaN();
  }

 private:
  static constexpr int none = -1;

  Window window_;
  int sector_ = none;  ///< whose positive pair is driven
  double worst_deg_ = 0.0, squares_ = 0.0;
  std::int64_t count_ = 0;
};

}  // namespace sixstep::study
