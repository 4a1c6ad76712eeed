// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/commission/commission_study.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/plant/general/plant.hpp"
#include "sixstep/rig/commissioning_drive.hpp"
#include "sixstep/rig/rig.hpp"
#include "sixstep/sim/run.hpp"

namespace sixstep::analysis {
namespace {

using control::CommissioningPhase;
using Plant = plant::general::Plant<double>;
using Rig = rig::Rig<double, rig::CommissioningDrive<double>, Plant>;

constexpr double row_s = 1e-3, turn_deg = 360.0;

double in_turn(double deg) { return deg - turn_deg * std::floor(deg / turn_deg); }
/// Wraps an angle to (-180, 180] degrees.
double apart(double deg) { return deg - turn_deg * std::floor(deg / turn_deg + 0.5); }

Rig rig_on(const CommissionBench& b) {
  const study::GeneralPlant& g = *b.compiled.general;
  return Rig(Plant(g.machine, g.shaft, g.devices, g.supply, g.start),
             control::commissioning_config(b.board, b.wish), b.compiled.board, {}, {}, b.compiled.wiring,
             b.compiled.probes);
}

void note(const Rig& rig, const CommissionBench& b, double t_s, CommissionStudy& s) {
  const CommissioningPhase now = rig.firmware().found().phase;
  if (!s.phases.empty()) s.phases.back().to_s = t_s;
  if (s.phases.empty() || s.phases.back().phase != now) s.phases.push_back({now, t_s, t_s});
  const auto& state = rig.plant().state();
  CommissionRow row{.t_s = t_s, .i_A = {}, .turns = 0.0};
  for (std::size_t leg = 0; leg < 3; ++leg) row.i_A[leg] = state.i[b.compiled.wiring.phase(leg)];
  row.turns = static_cast<double>(state.sector) / 6 + state.x / (2 * base::pi);
  s.rows.push_back(row);
}

/// The rotor's angle in the frame of the board, whose legs may be connected to other phases. A cyclic
/// exchange of the phases shifts the angle by thirds of a turn. Two swapped wires reverse the angle, because
/// they mirror the d axis; theta_e leads the d axis by 150 degrees.
double on_board_deg(const rig::Wiring& wires, double theta_e_deg) {
  const double at_a = 120.0 * static_cast<double>(wires.phase(0));
  return wires.phases < rig::WireOrder::acb ? theta_e_deg - at_a : 300.0 + at_a - theta_e_deg;
}

void compare_edges(CommissionStudy& s) {
  const rig::Wiring& wires = s.bench.compiled.wiring;
  const rig::ProbeGiven& probes = s.bench.compiled.probes;
  const bool mirrored = wires.phases >= rig::WireOrder::acb;
  const auto pins = [&](int n) {
    const int sector = (n + 6) % 6;
    return wires.at_pins(probes.spaced_60 ? plant::hall_code_60(sector) : plant::hall_code(sector));
  };
  double ahead = 0.0;
  for (int n = 0; n < 6; ++n) {
    const std::uint8_t behind = pins(n - 1), before = mirrored ? pins(n) : behind,
                       after = mirrored ? behind : pins(n);
    const std::uint8_t sector = s.state.probes.lines.sector[after];
    if (sector >= 6) return;
    const double true_deg = in_turn(on_board_deg(wires, 60.0 * n + probes.placement.offset_deg));
    const double found_deg = in_turn(s.state.probes.edges.at[sector] * (turn_deg / 4294967296.0));
    s.edges[sector] = {before, after, found_deg, true_deg};
    ahead += apart(true_deg - 60.0 * sector) / 6;
  }
  s.shown_offset_deg = ahead;
}

/// True if the Hall table turns the motor in the board's forward direction: each sector found equals the
/// sector at the pins.
bool turns_by(const CommissionStudy& s) {
  for (std::size_t sector = 0; sector < 6; ++sector)
    if (std::fabs(apart(s.edges[sector].true_deg - 60.0 * static_cast<double>(sector))) >
        30.0 + s.bounds.edge_deg)
      return false;
  return true;
}

const char* reason(sim::Stop stop) {
  if (stop == sim::Stop::fault) return "a fault";
  return stop == sim::Stop::unsettled ? "no consistent conduction mode"
                                      : "switching events that repeat without end at one instant";
}

}  // namespace

double CommissionStudy::worst_edge_deg() const {
  double worst = 0.0;
  for (const CommissionEdge& e : edges) worst = std::max(worst, std::fabs(apart(e.found_deg - e.true_deg)));
  return worst;
}

bool CommissionStudy::holds() const {
  const auto within = [](double x, double truth, double part) { return std::fabs(x - truth) <= part * x; };
  return done() && lines_found() && within(found.R_ohm, bench.truth.R_ohm, bounds.R_part) &&
         within(found.L_H, bench.truth.L_H, bounds.L_part) &&
         within(found.flux_linkage_Vs, bench.truth.flux_linkage_Vs, bounds.flux_part) &&
         worst_edge_deg() <= bounds.edge_deg &&
         std::fabs(found.hall_offset_deg - shown_offset_deg) <= bounds.edge_deg && turns_by(*this);
}

base::Result<CommissionStudy> study_commission(const CommissionOrder& order) {
  base::Result<CommissionBench> bench = commission_bench(order.subject);
  if (!bench) return bench.problems();
  CommissionStudy s{.subject = order.subject,
                    .bench = std::move(*bench),
                    .state = {},
                    .found = {},
                    .bounds = {},
                    .phases = {},
                    .rows = {}};
  Rig rig = rig_on(s.bench);
  sim::NoObserver none;
  note(rig, s.bench, 0.0, s);
  for (std::int64_t n = 1; rig.firmware().found().phase < CommissioningPhase::done; ++n) {
    if (order.keep_going && !order.keep_going())
      return base::Problem{"commission", "", "was interrupted", "start it again"};
    const double t_s = row_s * static_cast<double>(n);
    if (t_s > s.bench.longest_s) break;
    if (const sim::Stop stop = sim::run(rig, sim::to_instant(t_s), none).stop; stop != sim::Stop::end)
      return base::Problem{"motor", s.subject.motor,
                           std::string("cannot be commissioned: the simulation ended with ") + reason(stop) +
                               " before the commissioning test was complete",
                           "correct the values in the motor file"};
    note(rig, s.bench, t_s, s);
  }
  s.state = rig.firmware().found();
  s.seconds = s.rows.back().t_s;
  s.found = control::commissioned<double>(control::commissioning_scale<double>(s.bench.board), s.state);
  s.bounds = bounds_of(s.bench, s.state);
  if (s.lines_found()) compare_edges(s);
  return s;
}

}  // namespace sixstep::analysis
