// SPDX-License-Identifier: Apache-2.0
// Selects the close-ups of a report from the trace.
#pragma once
#include <optional>

#include "report/thinning.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace report {

/// A column by name; null if the trace does not contain it, or if it contains no number.
const std::vector<double>* find_column(const sixstep::study::Trace& trace, std::string_view name);

/// Whether the trace contains every row of the interval.
bool is_whole(const sixstep::study::Trace& trace, const Interval& interval);
/// The time from which on the trace contains every row; the first row's time if no row was replaced.
double whole_from_s(const sixstep::study::Trace& trace);

struct Windows {
  std::optional<Interval> periods;  ///< three PWM periods in which the bridge switches, as late as possible
  std::optional<Interval>
      commutation;  ///< interval around a Hall edge with a considerable current, as late as possible
  std::optional<Interval> step{};  ///< the largest change of the setpoint
};

Windows choose_windows(const sixstep::study::Trace& trace, const sixstep::study::Scenario& scenario);

}  // namespace report
