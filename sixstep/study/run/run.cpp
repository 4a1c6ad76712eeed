// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/run/run.hpp"

#include "sixstep/study/check/check.hpp"
#include "sixstep/study/measure/columns.hpp"
#include "sixstep/study/run/observers_of.hpp"
#include "sixstep/study/run/run_firmware.hpp"

namespace sixstep::study {

namespace {

/// A run pays for what its firmware does, and for nothing else.
base::Problems run_on_board(const Scenario& s, Compiled compiled, Observers& w, Outcome& out) {
  if (compiled.general)
    return s.control.drive == FirmwareKind::product ? run_product_on_general(s, std::move(compiled), w, out)
                                                    : run_sensed_on_general(s, std::move(compiled), w, out);
  if (s.control.drive == FirmwareKind::product) return run_product(s, std::move(compiled), w, out);
  const bool ideal = compiled.board.sensors.ideal();
  return ideal ? run_lean(s, std::move(compiled), w, out) : run_sensed(s, std::move(compiled), w, out);
}

}  // namespace

base::Result<Outcome> run(const Scenario& scenario, const Listeners& listeners) {
  if (base::Problems problems = check(scenario); !problems.empty()) return problems;
  base::Result<Compiled> compiled = compile(scenario);
  if (!compiled) return compiled.problems();
  const base::Result<std::vector<std::size_t>> indices = record_indices(scenario);
  if (!indices) return indices.problems();

  Outcome out;
  out.motor = compiled->motor;
  out.gains = compiled->gains;
  Observers w = observers_of(scenario, listeners, *indices);
  const bool on_general = compiled->general.has_value();
  const base::Problems problems = run_on_board(scenario, std::move(*compiled), w, out);
  if (!problems.empty()) return problems;
  const auto note_books = [&out](const auto& audit) {
    out.energy = audit.energy();
    out.laws = audit.laws();
  };
  if (w.audit) on_general ? note_books(w.audit->general) : note_books(w.audit->lean);
  w.figures.judge(scenario, out);
  return out;
}

/// A run that reaches its end stands there to rounding of the instant in seconds.
bool cut_short(const Scenario& scenario, const Outcome& outcome) {
  const bool stopped = outcome.fault && !outcome.trip;  // a drive that trips coasts on
  return !stopped && outcome.simulated_s < scenario.duration_s * (1.0 - 1e-9);
}

}  // namespace sixstep::study
