// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/run/run.hpp"

#include <memory>
#include <optional>
#include <utility>

#include "sixstep/study/check/check.hpp"
#include "sixstep/study/live/any_run.hpp"
#include "sixstep/study/measure/columns.hpp"
#include "sixstep/study/measure/laying.hpp"
#include "sixstep/study/run/conclude.hpp"
#include "sixstep/study/run/observers_of.hpp"

namespace sixstep::study {

namespace {

/// Runs the scenario in one slice, and writes the results.
base::Problems run_on_board(const Scenario& s, Compiled& compiled, Observers& w, Outcome& out) {
  base::Result<std::unique_ptr<detail::AnyRun>> run =
      detail::made_by(s, compiled, std::move(compiled.timeline));
  if (!run) return run.problems();
  Present present;
  std::optional<detail::LastSegment> last;
  sim::Instant reach;
  detail::Slice slice{w, present, last, compiled.end, reach, compiled.board.modulator.period_ticks, true};
  const sim::Stop stop = (*run)->advance(compiled.end, slice);
  return (*run)->end(stop, w, out);
}

}  // namespace

base::Result<Outcome> run(const Scenario& scenario, const Listeners& listeners, const OnCore& core) {
  if (base::Problems problems = check(scenario); !problems.empty()) return problems;
  base::Result<Compiled> compiled = compile(scenario);
  if (!compiled) return compiled.problems();
  compiled->board.core = core.beside;
  compiled->board.chip = core.instead;
  if (core.setpoint_range > 0.0) compiled->setpoint_range = core.setpoint_range;
  const base::Result<std::vector<std::size_t>> indices = record_indices(scenario);
  if (!indices) return indices.problems();

  Outcome out = outcome_of(*compiled);
  Laying laying(scenario);
  Observers w = observers_of(scenario, listeners, *indices);
  laying.watch(w.grids);
  const base::Problems problems = run_on_board(scenario, *compiled, w, out);
  if (!problems.empty()) return problems;
  conclude(scenario, *compiled, w, out);
  w.figures.judge(scenario, out);
  laying.judge(out);
  return out;
}

/// A complete run ends at the scenario's duration, except for rounding of the instant in seconds.
bool cut_short(const Scenario& scenario, const Outcome& outcome) {
  const bool stopped = outcome.fault && !outcome.trip;  // after a trip the drive coasts to the end
  return !stopped && outcome.simulated_s < scenario.duration_s * (1.0 - 1e-9);
}

}  // namespace sixstep::study
