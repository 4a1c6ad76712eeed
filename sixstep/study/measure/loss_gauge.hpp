// SPDX-License-Identifier: Apache-2.0
// Measures the mean switching loss over a window (plant/device_losses.hpp).
#pragma once
#include <limits>

#include "sixstep/plant/device_losses.hpp"
#include "sixstep/study/measure/signals.hpp"
#include "sixstep/study/measure/window.hpp"

namespace sixstep::study {

/// Adds the switching losses at a segment's beginning, if this instant lies within the window.
inline void begin_segment(plant::DeviceLosses& losses, const SegmentView& g, const Window& window) {
  const auto& y = g.plant.expansion();
  losses.begin(g.plant.legs(), plant::PerLeg<double>{y.i[0][0], y.i[1][0], y.i[2][0]}, y.bus[0],
               g.t_s >= window.from_s && g.t_s < window.to_s);
}

class SwitchingLossGauge {
 public:
  SwitchingLossGauge(const Window& window, const plant::SwitchingLaw& law) : window_(window), losses_(law) {}

  void segment(const SegmentView& g, double s) {
    begin_segment(losses_, g, window_);
    last_s_ = std::fmin(g.t_s + g.plant.expansion().h * s, window_.to_s);
  }
  /// Mean loss in W; NaN if the run ended before the window.
  double value() const {
    if (!(last_s_ > window_.from_s)) return std::numeric_limits<double>::quiet_NaN();
    return losses_.switching() / (last_s_ - window_.from_s);
  }

 private:
  Window window_;
  plant::DeviceLosses losses_;
  double last_s_ = 0.0;
};

}  // namespace sixstep::study
