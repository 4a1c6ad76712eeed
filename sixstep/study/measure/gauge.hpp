// SPDX-License-Identifier: Apache-2.0
// One figure of merit over one window, taken from the trajectory's polynomials as they pass: exact integrals,
// extremes and crossings, no samples between which something could hide.
#pragma once
#include <limits>
#include <optional>

#include "sixstep/study/measure/signals.hpp"
#include "sixstep/study/measure/window.hpp"

namespace sixstep::study {

class Gauge {
 public:
  /// `level` and `start` are what the step goes to and from (reach, rise and settling times, overshoot), and
  /// `level` what an error is counted from; without `start` the signal's value at the window's begin counts.
  Gauge(const Measure& measure, Window window, double level, std::optional<double> start)
      : measure_(measure), window_(window), level_(level), start_(start) {}

  const Window& window() const { return window_; }
  /// Whether a signal that stays within these bounds cannot change the result: its part may then be left out.
  bool holds(const series::Extremes<double>& bounds) const {
    if (!seen_) return false;
    const bool high = bounds.high <= highest_, low = bounds.low >= lowest_;
    switch (measure_.metric) {
      case MetricKind::maximum:
        return high;
      case MetricKind::minimum:
        return low;
      case MetricKind::peak_to_peak:
      case MetricKind::largest_error:
        return high && low;
      case MetricKind::overshoot:
        return sign() > 0 ? high : low;
      default:
        return false;
    }
  }
  bool seeks_extremes() const {
    const MetricKind m = measure_.metric;
    return m == MetricKind::maximum || m == MetricKind::minimum || m == MetricKind::peak_to_peak ||
           m == MetricKind::overshoot || m == MetricKind::largest_error;
  }
  /// The signal over [t0, t0 + length], inside the window, as a polynomial of s in [0, 1].
  void part(const Series& c, int degree, double t0, double length);
  /// What the controller sampled (measures with `sampled`).
  void sample(double t, double value);
  /// Infinite where the level was never reached or the signal never settled; empty where the window saw
  /// nothing.
  std::optional<double> value() const;

 private:
  void integrate_part(const Series& c, int degree, double length);
  void widen_part(const Series& c, int degree);
  void settle_part(const Series& c, int degree, double t0, double length);
  void reach_part(const Series& c, int degree, double t0, double length);
  std::optional<double> crossing(double fraction, const Series& c, int degree, double t0,
                                 double length) const;
  void merge(double mean, double squares, double length);
  double step_height(double first);
  double sign() const { return level_ < start_.value_or(0.0) ? -1.0 : 1.0; }

  Measure measure_;
  Window window_;
  double level_;
  std::optional<double> start_;
  bool seen_ = false;
  bool numbers_ = true;  ///< nothing that was seen was infinite or no number
  double integral_ = 0.0, seconds_ = 0.0, last_ = 0.0;
  double highest_ = -std::numeric_limits<double>::infinity(),
         lowest_ = std::numeric_limits<double>::infinity();
  double mean_ = 0.0, squares_ = 0.0;      ///< ripple: mean so far, and integral of the square about it
  std::optional<double> begun_, reached_;  ///< rise time: at 10 %; all of the way
  double outside_until_ = 0.0;             ///< last instant outside the band
  bool outside_now_ = true;
};

/// Rise times are taken between these parts of the way, as control textbooks do.
inline constexpr double rise_from = 0.1, rise_to = 0.9;

}  // namespace sixstep::study
