// SPDX-License-Identifier: Apache-2.0
// Parts that are common to the tests of a design: round numbers, windows, and the board's limits.
#pragma once
#include <cmath>
#include <limits>
#include <string>

#include "sixstep/analysis/verify/board.hpp"
#include "sixstep/analysis/verify/design_scenario.hpp"
#include "sixstep/base/decimal.hpp"

namespace sixstep::analysis {

/// A number rounded down to one digit: 10.9 -> 10.
inline double plain_number(double x) { return base::shortened(x, 1, base::Towards::down); }

/// A time in whole microseconds, rounded up, for a short text in the file.
inline double plain_time(double s) { return std::ceil(s * 1e6) / 1e6; }

inline study::Measure window_measure(study::MetricKind metric, study::Signal signal, double from_s,
                                     double to_s, const char* label) {
  study::Measure m;
  m.metric = metric;
  m.signal = signal;
  m.from_s = from_s;
  m.to_s = to_s;
  m.label = label;
  return m;
}

inline study::Measure step_measure(study::MetricKind metric, study::Signal signal, double from_s, double to_s,
                                   double start, double level, const char* label) {
  study::Measure m = window_measure(metric, signal, from_s, to_s, label);
  m.start = start;
  m.level = level;
  return m;
}

/// Limit of a quantity that the board does not bound.
inline constexpr double unbounded = std::numeric_limits<double>::infinity();

inline double allowed_current_A(const design::DriveDesign& d, const DesignSubject& subject) {
  return subject.board ? most_current_A(*subject.board, d.motor.K_t_Nm_A).value_or(unbounded) : unbounded;
}

inline double allowed_speed_rad_s(const DesignSubject& subject) {
  return subject.board ? most_speed_rad_s(*subject.board).value_or(unbounded) : unbounded;
}

/// Text that names the limit that determines a design's largest current.
inline std::string at_most_current(const design::DriveDesign& d) {
  return d.most_current_A() < d.current_at_full_torque_A ? "at the limit of the current" : "at full torque";
}

/// Adds the test of a position: one move, as in design_scenario.hpp.
void add_position(const design::DriveDesign& design, const DesignSubject& subject, study::Scenario& scenario);

}  // namespace sixstep::analysis
