// SPDX-License-Identifier: Apache-2.0
// Measures turn-ons per second: of the chopped switch, of the upper switches of three legs on average, or of
// one switch's gate.
#pragma once
#include <cstdint>
#include <limits>

#include "sixstep/study/measure/signals.hpp"
#include "sixstep/study/measure/window.hpp"

namespace sixstep::study {

class SwitchingGauge {
 public:
  /// `signal` selects a gate; any other signal means the chopped switch.
  SwitchingGauge(const Window& window, Signal signal) : window_(window), signal_(signal) {}

  void segment(const SegmentView& g, double s);
  /// Turn-ons per second, Hz; NaN if the run ended before the window.
  double value() const {
    if (!(last_s_ > window_.from_s)) return std::numeric_limits<double>::quiet_NaN();
    return static_cast<double>(after_ - before_) / switches_ / (last_s_ - window_.from_s);
  }

 private:
  std::int64_t count(const SegmentView& g);

  Window window_;
  Signal signal_;
  bool on_ = false;  ///< true: the gate is on; it is off before the run
  int switches_ = 1;
  std::int64_t gate_turn_ons_ = 0;
  std::int64_t before_ = 0, after_ = 0;
  double last_s_ = 0.0;
};

inline std::int64_t SwitchingGauge::count(const SegmentView& g) {
  if (!is_gate(signal_)) {
    switches_ = g.modulator.chopped();
    return g.modulator.turn_ons();
  }
  const bool on = signal_now(g, signal_) > 0.5;
  gate_turn_ons_ += int{on && !on_};
  on_ = on;
  return gate_turn_ons_;
}

inline void SwitchingGauge::segment(const SegmentView& g, double s) {
  const std::int64_t turn_ons = count(g);
  if (g.t_s < window_.from_s) before_ = turn_ons;
  if (g.t_s < window_.to_s) {
    after_ = turn_ons;
    last_s_ = std::fmin(g.t_s + g.plant.expansion().h * s, window_.to_s);
  }
}

}  // namespace sixstep::study
