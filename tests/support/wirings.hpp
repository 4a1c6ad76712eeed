// SPDX-License-Identifier: Apache-2.0
// A study of wirings with plausible results, for tests of the output. It does not need the 252 runs of a real
// study: the "measured" values are computed from theory.
#pragma once
#include <cmath>

#include "sixstep/analysis/wiring/wiring_study.hpp"
#include "sixstep/study/compile/compile.hpp"
#include "tests/support/scenarios.hpp"

namespace sixstep::testing {

inline analysis::FreeRun made_up_run(const analysis::WiringTheory& theory, double stalled_A) {
  const int way = analysis::direction_of(theory.does);
  analysis::FreeRun run{.speed_rad_s = 80.0 * way, .turns = 3.0 * way, .way_turns = 16.0 * way};
  run.phase_rms_A = way == 0                           ? 0.8 * stalled_A
                    : analysis::runs_well(theory.does) ? 0.02 * stalled_A
                                                       : 0.4 * stalled_A;
  run.peak_A = 2 * run.phase_rms_A;
  run.supply_A = 0.1 * run.phase_rms_A;
  run.swing_deg = way == 0 ? 40 : 1000;
  run.swing_Hz = way == 0 ? 50 : 0;
  for (int n = 0; n <= 400; ++n) {
    run.turned.push_back(static_cast<float>(way == 0 ? 0.1 * std::sin(0.2 * n) : 0.04 * n * way));
    run.current_A.push_back(static_cast<float>(stalled_A * std::exp(-0.02 * n)));
  }
  return run;
}

inline analysis::WiringStudy made_up_wirings(const design::Sheet& sheet = maxon_sheet()) {
  analysis::WiringStudy s;
  s.subject = {.motor = "m", .sheet = sheet};
  s.bench = *analysis::wiring_bench(s.subject);
  s.machine = study::compile(analysis::turned_run(s.bench, s.subject, {}))->general->machine;
  const analysis::PairTorque torque(s.machine, s.bench.current_A);
  for (const rig::Wiring& w : analysis::all_wirings()) {
    analysis::WiringCase c;
    c.wiring = w;
    c.theory = analysis::wiring_theory(torque, w);
    c.cures = analysis::shortest_cures(w);
    c.measured.does = c.theory.does;
    c.measured.torque_Nm_A = c.theory.mean_Nm_A;
    c.measured.part = c.theory.part;
    for (analysis::FreeRun& run : c.measured.runs) run = made_up_run(c.theory, s.bench.current_A);
    for (const analysis::TorquePoint& p : analysis::torque_over_turn(torque, w, 29))
      c.measured.torque_over_turn.push_back(static_cast<float>(p.torque_Nm_A));
    s.cases.push_back(std::move(c));
  }
  return s;
}

}  // namespace sixstep::testing
