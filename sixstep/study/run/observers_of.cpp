// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/run/observers_of.hpp"

#include "sixstep/study/measure/columns.hpp"

namespace sixstep::study {

namespace {

/// Curves drawn from row to row need about this many points over a run.
constexpr double drawn_points = 2000.0;

}  // namespace

Observers observers_of(const Scenario& s, const Listeners& listeners,
                       const std::vector<std::size_t>& indices) {
  const double gap_s = s.duration_s / drawn_points;
  Observers w{.figures = Figures(s, reference_levels(s)), .keep_going = listeners.keep_going};
  if (listeners.keep_books) w.audit.emplace();
  if (listeners.on_record && s.record.events)
    w.events.emplace(gap_s, indices, listeners.on_record);
  else if (listeners.on_record)
    w.grid.emplace(sim::to_instant(s.record.grid_s.value_or(s.pwm.period_s)).ticks,
                   sim::to_instant(s.duration_s), indices, listeners.on_record);
  std::vector<std::size_t> every(column_count);
  for (std::size_t c = 0; c < column_count; ++c) every[c] = c;
  if (listeners.on_event) w.report.emplace(gap_s, every, listeners.on_event);
  if (listeners.on_logic) w.logic.emplace(listeners.on_logic);
  return w;
}

}  // namespace sixstep::study
