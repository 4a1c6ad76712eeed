// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/run/observers_of.hpp"

#include "sixstep/study/compile/compile.hpp"
#include "sixstep/study/measure/columns.hpp"

namespace sixstep::study {

namespace {

/// Number of points over a run that a curve drawn from row to row needs.
constexpr double drawn_points = 2000.0;

/// Converts rows to the units of a linear motor's columns.
std::function<void(Row)> in_metres(const Scenario& s, const std::vector<std::size_t>& indices,
                                   const std::function<void(Row)>& to) {
  if (!to || s.sheet.kind == design::MotorKind::rotary) return to;
  std::vector<double> factors, row(indices.size());
  for (const std::size_t c : indices) factors.push_back(all_columns(s.sheet.kind)[c].per_turning);
  return [factors, row, to](Row values) mutable {
    for (std::size_t n = 0; n < row.size(); ++n) row[n] = values[n] * factors[n];
    to(row);
  };
}

}  // namespace

Observers observers_of(const Scenario& s, const Listeners& listeners,
                       const std::vector<std::size_t>& indices) {
  const double gap_s = s.duration_s / drawn_points;
  Observers w{.figures = Figures(s, reference_levels(s)), .keep_going = listeners.keep_going};
  if (s.sensors.currents == rig::CurrentMeasurement::dc_link)
    w.extremes.shunt_least_duty = least_shown_duty(s);
  const design::Friction friction = design::sheet_constants(s.sheet).friction;
  if (listeners.keep_books) w.winding = WindingWatch(s, friction);
  if (listeners.keep_books) w.audit.emplace();
  if (listeners.keep_books && tells_losses(s.bridge)) w.devices.emplace(s.bridge);
  const design::IronDrag& iron = friction.iron;
  if (listeners.keep_books && (iron.B_Nm_s > 0 || iron.coulomb_Nm > 0)) w.iron.emplace(iron);
  const std::function<void(Row)> on_record = in_metres(s, indices, listeners.on_record);
  if (on_record && s.record.events)
    w.events.emplace(gap_s, indices, on_record);
  else if (on_record)
    w.grids.push_back(GridRecorder(sim::to_instant(s.record.grid_s.value_or(s.pwm.period_s)).ticks,
                                   sim::to_instant(s.duration_s), indices, on_record));
  std::vector<std::size_t> every(column_count);
  for (std::size_t c = 0; c < column_count; ++c) every[c] = c;
  if (listeners.on_event) w.report.emplace(gap_s, every, listeners.on_event);
  if (listeners.on_logic) w.logic.emplace(listeners.on_logic);
  return w;
}

}  // namespace sixstep::study
