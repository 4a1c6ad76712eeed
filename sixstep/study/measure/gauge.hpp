// SPDX-License-Identifier: Apache-2.0
// Measures one figure of merit of a signal over one window, from the trajectory's polynomials: exact
// integrals, extremes and crossings. No event between samples can be missed. mean_gauges.hpp,
// extreme_gauges.hpp and step_gauges.hpp define the single figures.
#pragma once
#include <optional>

#include "sixstep/study/measure/any_gauge.hpp"
#include "sixstep/study/measure/window.hpp"

namespace sixstep::study {

class Gauge {
 public:
  /// A step goes from `start` to `level` (reach, rise and settling times, overshoot); errors are counted from
  /// `level`. Without `start` the step starts at the signal's value at the window's beginning.
  Gauge(const Measure& measure, Window window, double level, std::optional<double> start);

  const Window& window() const { return window_; }
  /// True if a signal within its bounds cannot change the result, so that this part of the signal may be left
  /// out. `bounds` is called only for figures where a part can be left out.
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
  /// Adds the signal over [t0, t0 + length], inside the window, as a polynomial of s in [0, 1].
  void part(const Series& c, int degree, double t0, double length);
  /// Adds a value that the controller sampled (measures with `sampled`).
  void sample(double t, double value);
  /// The figure's value. Infinite if the level was never reached or the signal never settled; empty if no
  /// time of the window was simulated.
  std::optional<double> value() const;

 private:
  void see(double value);

  AnyGauge gauge_;
  Window window_;
  bool sampled_;
  bool seen_ = false;
  bool numbers_ = true;  ///< true: no value so far was infinite or NaN
};

}  // namespace sixstep::study
