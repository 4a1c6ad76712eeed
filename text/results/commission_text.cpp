// SPDX-License-Identifier: Apache-2.0
#include "text/results/commission_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "text/escape/escape.hpp"
#include "text/results/hall_words.hpp"
#include "text/results/interval_text.hpp"
#include "text/results/quantity_text.hpp"
#include "text/results/text_rows.hpp"
#include "text/results/wiring_words.hpp"

namespace text {
namespace {

using analysis::CommissionStudy;
using sixstep::control::CommissioningFault;
using sixstep::control::CommissioningPhase;
using sixstep::control::HallSurvey;

const char* held(bool holds) { return holds ? "" : "OUT OF BOUND"; }

void add_part(Rows& rows, const char* what, double x, double truth, double bound, const char* unit) {
  if (!(x > 0.0)) return;
  rows.add({what, quantity_text(x, unit), quantity_text(truth, unit),
            fmt::format("{:+.2f} %", 100 * (x / truth - 1)), fmt::format("{:.2f} %", 100 * bound),
            held(std::fabs(x - truth) <= bound * x)});
}

void add_angle(Rows& rows, const std::string& what, double x, double truth, double bound) {
  const double off = std::remainder(x - truth, 360.0);
  // Adding 0.0 turns a zero that is negative by rounding into a positive one.
  rows.add({what, fmt::format("{:.2f} deg", x + 0.0), fmt::format("{:.2f} deg", truth + 0.0),
            fmt::format("{:+.2f} deg", off), fmt::format("{:.2f} deg", bound),
            held(std::fabs(off) <= bound)});
}

std::string numbers(const CommissionStudy& s) {
  Rows rows;
  rows.add({"", "found", fmt::format("is, at {:.4g} degC", s.bench.truth.degC), "off by", "bound"});
  add_part(rows, "resistance", s.found.R_ohm, s.bench.truth.R_ohm, s.bounds.R_part, "ohm");
  add_part(rows, "inductance", s.found.L_H, s.bench.truth.L_H, s.bounds.L_part, "H");
  add_part(rows, "flux linkage", s.found.flux_linkage_Vs, s.bench.truth.flux_linkage_Vs, s.bounds.flux_part,
           "Wb");
  if (s.lines_found()) {
    add_angle(rows, "Hall offset", s.found.hall_offset_deg, s.shown_offset_deg, s.bounds.edge_deg);
    for (std::size_t n = 0; n < 6; ++n) {
      const analysis::CommissionEdge& e = s.edges[n];
      add_angle(rows, fmt::format("edge {} {}", code_word(e.before), code_word(e.after)), e.found_deg,
                e.true_deg, s.bounds.edge_deg);
    }
  }
  return rows.text() +
         "Resistance: of a phase and its leg (a switch, and a diode in the dead time). Inductance: of a phase, along the magnet. Angles are electrical.\n";
}

/// Explains crossed phases: the chip names a phase by its leg, so that crossed phases change the probes'
/// numbers and perhaps the direction.
std::string crossed_phases(const sixstep::rig::Wiring& wires) {
  using sixstep::rig::WireOrder;
  if (wires.phases == WireOrder::abc) return "";
  const bool turns_over = wires.phases != WireOrder::bca && wires.phases != WireOrder::cab;
  return fmt::format("Phases {} are at the legs a b c. The chip names phases and probes by its legs{}.\n",
                     phases_word(wires),
                     turns_over ? "; its forward direction is backward for the motor" : "");
}

std::string lines(const CommissionStudy& s) {
  if (!s.lines_found()) return "";
  const sixstep::control::HallLines& found = s.state.probes.lines;
  Rows rows;
  rows.add({"pins H1 H2 H3", "sector", "high", "low"});
  for (std::uint8_t sector = 0; sector < 6; ++sector)
    for (std::uint8_t pins = 0; pins < 8; ++pins) {
      if (found.sector[pins] != sector) continue;
      const sixstep::control::Pair pair = sixstep::control::positive_pair(sector);
      rows.add({code_word(pins), fmt::format("{}", sector), std::string(1, leg_word(pair.source)),
                std::string(1, leg_word(pair.sink))});
    }
  const std::string probes = fmt::format("{} {} {}", found.probe[0], found.probe[1], found.probe[2]);
  const std::string inverted = inverted_word(found.inverted);
  return fmt::format(
             "Hall lines as measured by the board: probes {} at H1 H2 H3{}; the rotor {} {:.1f} deg each way\n",
             probes, inverted == "none" ? "" : ", inverted: " + inverted,
             s.found.hall_lag_deg < 0 ? "leads" : "lags", std::fabs(s.found.hall_lag_deg)) +
         rows.text() +
         "A drive that reads this table with as_wired() of hall_survey.hpp needs no change of the wires. To move wires instead, see `sixstep motor wiring`.\n" +
         crossed_phases(s.subject.wires);
}

std::string times(const CommissionStudy& s) {
  Rows rows;
  rows.add({"phase", "from", "for"});
  for (const analysis::CommissionPhase& p : s.phases)
    if (p.phase < CommissioningPhase::done)
      rows.add({std::string(phase_word(p.phase)), fmt::format("{:7.3f} s", p.from_s),
                fmt::format("{:.3f} s", p.to_s - p.from_s)});
  return rows.text();
}

std::string bench(const CommissionStudy& s) {
  const analysis::CommissionBench& b = s.bench;
  const auto& sensors = b.compiled.board.sensors;
  return fmt::format(
      "{}: {} V, legs at phases {}, pins at probes {}; {} A of test current{}\n"
      "{} bits over +-{}, one count of noise, 12 of offset; PWM and samples every {}, dead time 0.5 us, diodes\n",
      visible(s.subject.sheet.name), quantity_text(b.voltage_V, ""), phases_word(s.subject.wires),
      hall_lines_word(s.subject.wires), quantity_text(b.wish.test_A, ""), stand_in_words(b),
      sensors.current.bits, quantity_text(sensors.current.range, "A"), quantity_text(b.board.period_s, "s"));
}

const char* fault_words(CommissioningFault fault) {
  switch (fault) {
    case CommissioningFault::offset:
      return "the offset of a current amplifier is too large: check the amplifier";
    case CommissioningFault::current:
      return "the longest voltage vector does not reach the test current: check the wires, raise --voltage, or lower --current";
    case CommissioningFault::winding:
      return "the two current levels differ too little to compute a resistance: raise --current";
    case CommissioningFault::not_turned:
      return "the rotor did not follow a slow field: free the shaft, or raise --current";
    case CommissioningFault::none:
      break;
  }
  return "";
}

std::string survey_words(const CommissionStudy& s) {
  switch (s.state.probes.verdict) {
    case HallSurvey::dead_line:
      return "Hall line at H" + inverted_word(s.state.probes.dead_pins) +
             " never changed: check this line's probe, the probe's supply and the line's pull-up";
    case HallSurvey::other_codes:
      return "Hall lines do not show six codes in one order: look for a shorted line, and check that each probe switches at every magnet pole";
    case HallSurvey::not_steady:
      return "Hall edges were missed or do not repeat: the rotor does not follow the slow field steadily, because of cogging, dead time or diodes. Raise --current";
    case HallSurvey::good:
      break;
  }
  return "";
}

}  // namespace

std::string_view phase_word(CommissioningPhase phase) {
  switch (phase) {
    case CommissioningPhase::zeroing:
      return "zeroing";
    case CommissioningPhase::rising:
      return "rising";
    case CommissioningPhase::leaning:
      return "leaning";
    case CommissioningPhase::aligning:
      return "aligning";
    case CommissioningPhase::stepping:
      return "stepping";
    case CommissioningPhase::turning:
      return "turning";
    case CommissioningPhase::spinning:
      return "spinning";
    case CommissioningPhase::measuring:
      return "measuring";
    case CommissioningPhase::done:
      return "done";
    case CommissioningPhase::failed:
      return "failed";
  }
  return "";
}

std::string commission_failure(const CommissionStudy& s) {
  std::string out;
  if (s.state.phase == CommissioningPhase::failed)
    out = fault_words(s.state.fault);
  else if (!s.done())
    out = fmt::format(
        "the chip was still {} after {}, because the rotor follows the field too slowly: raise --current",
        phase_word(s.state.phase), quantity_text(s.seconds, "s", 3));
  if (s.lines_found() || s.state.phase < CommissioningPhase::turning ||
      s.state.fault == CommissioningFault::offset || s.state.fault == CommissioningFault::current ||
      s.state.fault == CommissioningFault::winding)
    return out;
  return out + (out.empty() ? "" : "; ") + survey_words(s);
}

std::string stand_in_words(const analysis::CommissionBench& bench) {
  using analysis::TestCurrent;
  if (bench.nominal_printed || bench.from == TestCurrent::asked_for) return "";
  return std::string(bench.from == TestCurrent::half_of_most ? ", half of the largest current of this test"
                                                             : ", a fifth of the current at full duty") +
         ": the sheet names no nominal current";
}

std::string commission_text(const CommissionStudy& s) {
  std::string out = bench(s) + "\n" + numbers(s);
  if (const std::string found = lines(s); !found.empty()) out += "\n" + found;
  out += "\n" + times(s) + "\n";
  if (const std::string why = commission_failure(s); !why.empty()) return out + "NOT FOUND: " + why + "\n";
  return out + (s.holds() ? "All values were found, within their bounds.\n"
                          : "NOT ALL values are within their bounds.\n");
}

std::string commission_toml(const CommissionStudy& s) {
  std::string out =
      "# as the chip measured: between a terminal and the star point, with the channel of a switch in the resistance; bounds are the chip's\n";
  const auto line = [&](const char* key, double x, double bound, const char* more) {
    const analysis::Interval shown = analysis::around(x, bound * x);
    out += fmt::format("{} = {{ value = {}, {}source = \"commissioned\", kind = \"measured\" }}  # {}\n", key,
                       measured_text(shown), more, bounds_text(shown));
  };
  if (s.found.R_ohm > 0) line("resistance_ohm", s.found.R_ohm, s.bounds.R_part, "frame = \"phase\", ");
  if (s.found.L_H > 0) line("inductance_mH", 1e3 * s.found.L_H, s.bounds.L_part, "frame = \"phase\", ");
  if (s.found.flux_linkage_Vs > 0)
    line("flux_linkage_mWb", 1e3 * s.found.flux_linkage_Vs, s.bounds.flux_part, "");
  if (!s.lines_found()) return out;
  const sixstep::control::HallLines& found = s.state.probes.lines;
  return out +
         fmt::format(
             "# [sensors] of a scenario whose phases a, b, c are at legs a, b, c\n# hall_lines = \"{}{}{}\"\n# hall_inverted = \"{}\"\n# hall_offset_deg = {:.2f}  # +- {:.2f}\n",
             found.probe[0], found.probe[1], found.probe[2], inverted_word(found.inverted),
             s.found.hall_offset_deg, s.bounds.edge_deg);
}

}  // namespace text
