// SPDX-License-Identifier: Apache-2.0
// One figure of merit of a signal over one window, taken from the trajectory's polynomials as they pass:
// exact integrals, extremes and crossings, no samples between which something could hide. What each figure
// looks for stands in mean_gauges.hpp, extreme_gauges.hpp and step_gauges.hpp.
#pragma once
#include <optional>

#include "sixstep/study/measure/any_gauge.hpp"
#include "sixstep/study/measure/window.hpp"

namespace sixstep::study {

class Gauge {
 public:
  /// `level` and `start` are what the step goes to and from (reach, rise and settling times, overshoot), and
  /// `level` what an error is counted from; without `start` the signal's value at the window's begin counts.
  Gauge(const Measure& measure, Window window, double level, std::optional<double> start);

  const Window& window() const { return window_; }
  /// Whether a signal that stays within its bounds cannot change the result: its part may then be left out.
  /// `bounds` is asked only where that can be.
  template <class Bounds>
  bool holds(Bounds&& bounds) const {
    return std::visit(
        [&](const auto& gauge) {
          if constexpr (requires(const Extremes& r) { gauge.holds(r); })
            return gauge.holds(bounds());
          else
            return false;
        },
        gauge_);
  }
  /// The signal over [t0, t0 + length], inside the window, as a polynomial of s in [0, 1].
  void part(const Series& c, int degree, double t0, double length);
  /// What the controller sampled (measures with `sampled`).
  void sample(double t, double value);
  /// Infinite where the level was never reached or the signal never settled; empty where the window saw
  /// nothing.
  std::optional<double> value() const;

 private:
  void see(double value);

  AnyGauge gauge_;
  Window window_;
  bool sampled_;
  bool seen_ = false;
  bool numbers_ = true;  ///< nothing that was seen was infinite or no number
};

}  // namespace sixstep::study
