// SPDX-License-Identifier: Apache-2.0
// The close-ups a report offers, chosen from the trace itself.
#pragma once
#include <optional>

#include "report/thinning.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace report {

/// A column by name; null where the trace has none or it never holds a number.
const std::vector<double>* find_column(const sixstep::study::Trace& trace, std::string_view name);

/// Whether every row of the interval stands in the trace.
bool is_whole(const sixstep::study::Trace& trace, const Interval& interval);
/// From when on every row stands; the first row's time where all do.
double whole_from_s(const sixstep::study::Trace& trace);

struct Windows {
  std::optional<Interval> periods;  ///< three PWM periods in which the bridge switches, as late as possible
  std::optional<Interval>
      commutation;                 ///< around a Hall edge under considerable current, as late as possible
  std::optional<Interval> step{};  ///< the largest change of what is asked for
};

Windows choose_windows(const sixstep::study::Trace& trace, const sixstep::study::Scenario& scenario);

}  // namespace report
