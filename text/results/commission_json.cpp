// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "text/escape/escape.hpp"
#include "text/results/commission_text.hpp"
#include "text/results/hall_words.hpp"
#include "text/results/wiring_words.hpp"

namespace text {
namespace {

using Json = nlohmann::ordered_json;
using analysis::CommissionStudy;

Json quantity(double found, double truth, double bound) {
  if (!(found > 0.0)) return nullptr;
  return {{"found", found}, {"is", truth}, {"off_part", found / truth - 1}, {"bound_part", bound}};
}

Json hall(const CommissionStudy& s) {
  if (!s.lines_found()) return nullptr;
  const sixstep::control::HallLines& lines = s.state.probes.lines;
  Json out = {{"probes_at_pins", {lines.probe[0], lines.probe[1], lines.probe[2]}},
              {"inverted", inverted_word(lines.inverted)},
              {"straight", s.state.probes.plain},
              {"offset_deg", s.found.hall_offset_deg},
              {"true_offset_deg", s.shown_offset_deg},
              {"lag_deg", s.found.hall_lag_deg},
              {"bound_deg", s.bounds.edge_deg}};
  out["sectors"] = Json::array();
  for (const analysis::CommissionEdge& e : s.edges)
    out["sectors"].push_back({{"before", code_word(e.before)},
                              {"code", code_word(e.after)},
                              {"edge_deg", e.found_deg},
                              {"true_edge_deg", e.true_deg}});
  return out;
}

}  // namespace

std::string commission_json(const CommissionStudy& s) {
  const analysis::CommissionBench& b = s.bench;
  Json out = {{"sixstep", SIXSTEP_VERSION},
              {"motor", s.subject.sheet.name},
              {"voltage_V", b.voltage_V},
              {"test_A", b.wish.test_A},
              {"nominal_current_printed", b.nominal_printed},
              {"period_s", b.board.period_s},
              {"phases", phases_word(s.subject.wires)},
              {"hall_lines", hall_lines_word(s.subject.wires)},
              {"seed", s.subject.seed},
              {"degC", b.truth.degC},
              {"holds", s.holds()},
              {"failure", commission_failure(s)}};
  out["resistance_ohm"] = quantity(s.found.R_ohm, b.truth.R_ohm, s.bounds.R_part);
  out["inductance_H"] = quantity(s.found.L_H, b.truth.L_H, s.bounds.L_part);
  out["flux_linkage_Vs"] = quantity(s.found.flux_linkage_Vs, b.truth.flux_linkage_Vs, s.bounds.flux_part);
  out["hall"] = hall(s);
  out["phases_of_test"] = Json::array();
  for (const analysis::CommissionPhase& p : s.phases)
    out["phases_of_test"].push_back({{"phase", phase_word(p.phase)}, {"from_s", p.from_s}, {"to_s", p.to_s}});
  return visible(out.dump(2, ' ', false, Json::error_handler_t::replace), Lines::kept) + "\n";
}

}  // namespace text
