// SPDX-License-Identifier: Apache-2.0
// Measures the step of a signal from `start` to `level`: the time at which the signal reaches the level, and
// the time from which it stays at the level. A time is infinite if its event never occurs.
#pragma once
#include <optional>

#include "sixstep/study/measure/signals.hpp"

namespace sixstep::study {

/// Rise times are measured between these fractions of the step, as in control textbooks.
inline constexpr double rise_from = 0.1, rise_to = 0.9;

/// A step of the reference. Without `start`, it starts at the signal's first value.
struct Step {
  double level = 0.0;
  std::optional<double> start;

  void begin(double first) {
    if (!start) start = first;
  }
  double height() const;
  double sign() const { return level < start.value_or(0.0) ? -1.0 : 1.0; }
  /// Time in s at which `fraction` of the step is reached; empty if this part of the signal does not reach
  /// it.
  std::optional<double> crossing(double fraction, const Series& c, int degree, double t0,
                                 double length) const;
  /// True if a value has reached `fraction` of the step.
  bool made(double fraction, double value) const {
    return sign() * (value - *start - fraction * (level - *start)) >= 0.0;
  }
};

class ReachTime {
 public:
  ReachTime(const Step& step, double fraction) : step_(step), fraction_(fraction) {}
  void part(const Series& c, int degree, double t0, double length);
  void sample(double t, double value);
  double value(double from_s) const;

 private:
  Step step_;
  double fraction_;
  std::optional<double> reached_;
};

class RiseTime {
 public:
  explicit RiseTime(const Step& step) : step_(step) {}
  void part(const Series& c, int degree, double t0, double length);
  void sample(double t, double value);
  double value(double from_s) const;

 private:
  Step step_;
  std::optional<double> begun_, reached_;
};

class SettlingTime {
 public:
  SettlingTime(const Step& step, double band) : step_(step), band_(band) {}
  void part(const Series& c, int degree, double t0, double length);
  /// The signal counts as settled from the first sample on that lies, as all later samples, inside the band.
  void sample(double t, double value);
  double value(double from_s) const;

 private:
  Step step_;
  double band_;
  double outside_until_ = 0.0;  ///< last instant outside the band
  bool outside_now_ = true;
};

}  // namespace sixstep::study
