// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/run/run.hpp"

#include "sixstep/study/check/check.hpp"
#include "sixstep/study/measure/columns.hpp"
#include "sixstep/study/run/run_firmware.hpp"

namespace sixstep::study {

namespace {

/// Curves drawn from row to row need about this many points over a run.
constexpr double drawn_points = 2000.0;

Observers observers(const Scenario& s, const Compiled& compiled, const Listeners& listeners,
                    const std::vector<std::size_t>& indices) {
  const control::Mode mode = s.control.mode;
  const double gap_s = s.duration_s / drawn_points;
  Observers w{.figures = Figures(s, reference_levels(s)), .keep_going = listeners.keep_going};
  if (listeners.keep_books) w.audit.emplace();
  if (listeners.on_record && s.record.events)
    w.events.emplace(gap_s, mode, indices, listeners.on_record);
  else if (listeners.on_record)
    w.grid.emplace(sim::to_instant(s.record.grid_s.value_or(s.pwm.period_s)).ticks, compiled.end, mode,
                   indices, listeners.on_record);
  std::vector<std::size_t> every(column_count);
  for (std::size_t c = 0; c < column_count; ++c) every[c] = c;
  if (listeners.on_event) w.report.emplace(gap_s, mode, every, listeners.on_event);
  if (listeners.on_logic) w.logic.emplace(listeners.on_logic);
  return w;
}

/// A run pays for what its firmware does, and for nothing else.
base::Problems run_on_board(const Scenario& s, const Compiled& compiled, Observers& w, Outcome& out) {
  if (s.control.drive == FirmwareKind::product) return run_product(s, compiled, w, out);
  return compiled.board.sensors.ideal() ? run_lean(s, compiled, w, out) : run_sensed(s, compiled, w, out);
}

}  // namespace

base::Result<Outcome> run(const Scenario& scenario, const Listeners& listeners) {
  if (base::Problems problems = check(scenario); !problems.empty()) return problems;
  const base::Result<Compiled> compiled = compile(scenario);
  if (!compiled) return compiled.problems();
  const base::Result<std::vector<std::size_t>> indices = record_indices(scenario);
  if (!indices) return indices.problems();

  Outcome out;
  out.motor = compiled->motor;
  out.gains = compiled->gains;
  Observers w = observers(scenario, *compiled, listeners, *indices);
  const base::Problems problems = run_on_board(scenario, *compiled, w, out);
  if (!problems.empty()) return problems;
  if (w.audit) {
    out.energy = w.audit->energy();
    out.laws = w.audit->laws();
  }
  w.figures.judge(scenario, out);
  return out;
}

/// A run that reaches its end stands there to rounding of the instant in seconds.
bool cut_short(const Scenario& scenario, const Outcome& outcome) {
  const bool stopped = outcome.fault && !outcome.trip;  // a drive that trips coasts on
  return !stopped && outcome.simulated_s < scenario.duration_s * (1.0 - 1e-9);
}

}  // namespace sixstep::study
