// SPDX-License-Identifier: Apache-2.0
// Measures the angle error of commutation: the rotor's electrical angle at each commutation minus the sector
// edge of this commutation, in the direction of rotation. Late is positive.
//
// The pair of sector k changes to the pair of sector k + 1 at 60 (k + 1) degrees, and to the pair of sector k
// - 1 at 60 k degrees. For negative torque the drive uses the reversed pair, which is the pair of sector k +
// 3, so that the edge is 180 degrees away.
//
// The gauge applies to every kind of position sensing. It ignores a change of the pair by more than one
// sector, and the first pair after an off state.
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
  /// The error of the largest magnitude, degrees; NaN if no pair changed in the window.
  double worst_deg() const { return count_ > 0 ? worst_deg_ : std::numeric_limits<double>::quiet_NaN(); }
  double rms_deg() const {
    return count_ > 0 ? std::sqrt(squares_ / static_cast<double>(count_))
                      : std::numeric_limits<double>::quiet_NaN();
  }

 private:
  static constexpr int none = -1;

  Window window_;
  int sector_ = none;  ///< the sector whose positive pair is driven
  double worst_deg_ = 0.0, squares_ = 0.0;
  std::int64_t count_ = 0;
};

}  // namespace sixstep::study
