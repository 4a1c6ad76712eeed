// SPDX-License-Identifier: Apache-2.0
#include "text/results/identify_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "text/escape/escape.hpp"
#include "text/results/hall_words.hpp"
#include "text/results/interval_text.hpp"
#include "text/results/quantity_text.hpp"
#include "text/results/text_rows.hpp"

namespace text {
namespace {

using analysis::HallIdentity;
using analysis::IdentifiedPlace;
using analysis::Interval;

std::string count(std::size_t n, const char* one, const char* many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

std::string heading(const std::string& name, const HallIdentity& f) {
  const std::size_t edges = f.forward + f.backward;
  std::string out =
      fmt::format("{}: {}{} in {}, {} edges", visible(name), count(f.rows, "row", "rows"),
                  f.rows_are_changes ? ", each a change," : "", quantity_text(f.seconds, "s", 4), edges);
  if (f.place)
    out += fmt::format(", {} forward and {} backward", f.forward, f.backward);
  else if (f.forward > 0 && f.backward > 0)
    out += ", both ways";
  out += "\n";
  if (f.glitches > 0) out += fmt::format("  {} taken out\n", count(f.glitches, "glitch", "glitches"));
  if (f.skipped > 0)
    out += fmt::format("  {} passed between two rows: sample faster, or turn the shaft more slowly\n",
                       count(f.skipped, "sector", "sectors"));
  if (f.left_out > 0)
    out += fmt::format("  {} not used, more than five standard deviations from the fit\n",
                       count(f.left_out, "edge", "edges"));
  if (f.voltages_left_out > 0)
    out += fmt::format("  {} of the voltages not used, more than five standard deviations from the fit\n",
                       count(f.voltages_left_out, "reading", "readings"));
  if (f.place && f.place->at_turns > 0)
    out += fmt::format("  {} not used, because the rotor reversed after {}\n",
                       count(f.place->at_turns, "edge", "edges"), f.place->at_turns == 1 ? "it" : "them");
  if (f.unused > 0)
    out += fmt::format("  {} after the first {} not used\n", count(f.unused, "edge", "edges"), edges);
  return out;
}

std::string never_seen(const HallIdentity& f) {
  return code_word(f.mask) + " and " + code_word(static_cast<std::uint8_t>(f.mask ^ 7));
}

/// The meaning of the pair of codes that never occurs, whichever pins the lines have.
std::string spacing_words(const HallIdentity& f) {
  if (f.mask == 0b000) return "probes 120 degrees apart, or 60, some inverted";
  const int pin = f.mask == 0b100 ? 1 : f.mask == 0b010 ? 2 : 3;
  return fmt::format("probes 60 degrees apart, the middle one at H{0}, or 120 degrees, H{0} inverted", pin);
}

/// Explains the same log without inverted lines. An inverted line equals the line shifted by half a turn.
/// Three inverted lines therefore equal lines in another order with an offset that differs by 60 degrees. A
/// scenario and an assembly may have such an offset, although each edge is then farther from its nominal
/// angle.
std::string none_inverted_words(const IdentifiedPlace& p) {
  analysis::HallWires wires = p.wires.front();
  if (wires.inverted != 0b111) return "";
  const bool further = p.offset_deg.value < 0.0;
  analysis::PinCodes codes = p.codes;
  std::rotate(codes.begin(), further ? codes.begin() + 1 : codes.end() - 1, codes.end());
  for (const analysis::HallWires& other : analysis::wires_behind(codes))
    if (other.inverted == 0) wires = other;
  return fmt::format("or, {} deg off: {}, none inverted",
                     as_good_as(p.offset_deg.value + (further ? 60.0 : -60.0), p.offset_deg),
                     wires_words(wires));
}

void add(Rows& rows, const char* what, const Interval& x, double factor, const char* unit,
         const std::string& remark = "") {
  const Interval shown = analysis::scaled(x, factor);
  rows.add({what, measured_text(shown) + " " + unit, bounds_text(shown), remark});
}

void add_jitter(Rows& rows, const HallIdentity& f) {
  if (f.jitter_deg.low > 0.0)
    add(rows, "jitter", f.jitter_deg, 1.0, "deg rms");
  else
    rows.add({"jitter", fmt::format("<= {:.2g} deg rms", f.jitter_deg.high), "",
              f.place ? "" : "includes the rotor's own speed variation"});
}

std::string wires_section(const HallIdentity& f) {
  Rows rows;
  rows.add({"Wires", "", "sure"});
  rows.add({"never seen", never_seen(f) + ": " + spacing_words(f), certainty_text(f.mask_probability)});
  if (!f.place) {
    rows.add({"order", "not known from Hall codes: also record u_ab and u_bc", ""});
    return rows.text();
  }
  const IdentifiedPlace& p = *f.place;
  const std::string most = f.forward > 0 && f.backward > 0 ? " most of the log" : "";
  rows.add(
      {"turned",
       p.forward ? "forward" + most + ": phase order a, b, c" : "backward" + most + ": phase order c, b, a",
       certainty_text(p.order_probability)});
  rows.add({"lines", wires_words(p.wires.front()), certainty_text(p.probability)});
  for (std::size_t n = 1; n < p.wires.size() && n < 3; ++n)
    rows.add({"", "or " + wires_words(p.wires[n]), ""});
  const std::string none = none_inverted_words(p), moves = moves_words(p.wires.front().probes);
  if (!none.empty()) rows.add({"", none, ""});
  // If an offset explains the lines as well as the wires do, perhaps no wire needs to be moved.
  if (none.empty() && !moves.empty()) rows.add({"to mend", "move " + moves, ""});
  return rows.text();
}

std::string numbers_section(const HallIdentity& f) {
  Rows rows;
  rows.add({"Electrical degrees", "", "95 %"});
  if (f.place) {
    const IdentifiedPlace& p = *f.place;
    add(rows, "offset", p.offset_deg, 1.0, "deg", p.both_ways ? "" : "as measured in this direction");
    if (p.hysteresis_deg)
      add(rows, "hysteresis", *p.hysteresis_deg, 1.0, "deg");
    else if (p.both_ways)
      rows.add({"hysteresis", "not found: turn the shaft by more than one turn before each reversal", ""});
  }
  add_jitter(rows, f);
  if (f.place) {
    const IdentifiedPlace& p = *f.place;
    if (p.delay_s) add(rows, "delay", *p.delay_s, 1e6, "us", "by which the lines follow the voltages");
    add(rows, "flux linkage", p.flux_linkage_Vs, 1e3, "mWb",
        fmt::format("{:.4g} % of the voltages' power comes from the rotor", 100.0 * p.explained));
  }
  return rows.text();
}

std::string edges_section(const HallIdentity& f) {
  Rows rows;
  rows.add({"Edge", "at", "codes", "own", "95 %", "seen"});
  for (std::size_t n = 0; n < f.edges.size(); ++n) {
    const analysis::IdentifiedEdge& e = f.edges[n];
    rows.add({std::to_string(n), f.place ? fmt::format("{} deg", 60 * n) : "",
              code_word(e.before) + " " + code_word(e.after), measured_text(e.own_deg),
              bounds_text(e.own_deg), std::to_string(e.seen)});
  }
  return rows.text();
}

std::string table_section(const IdentifiedPlace& p) {
  Rows rows;
  rows.add({"Code", "sector", "high", "low", "for positive torque"});
  for (const analysis::CodePair& row : analysis::commutation_of(p.codes))
    rows.add({code_word(row.code), std::to_string(row.sector), std::string(1, leg_word(row.pair.source)),
              std::string(1, leg_word(row.pair.sink))});
  return rows.text();
}

/// Writes each line as a comment.
std::string as_remarks(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    out += end > at ? "# " + text.substr(at, end - at) + "\n" : "#\n";
    at = end + 1;
  }
  return out;
}

std::string identified_motor_line(const HallIdentity& f, const std::string& name) {
  const Interval mWb = analysis::scaled(f.place->flux_linkage_Vs, 1e3);
  return fmt::format("flux_linkage_mWb = {{ value = {}, source = {}, kind = \"measured\" }}  # 95 %: {}\n",
                     measured_text(mWb), toml_text(name), bounds_text(mWb));
}

}  // namespace

std::string identify_text(const std::string& name, const HallIdentity& f) {
  std::string out =
      heading(name, f) + "\n" + wires_section(f) + "\n" + numbers_section(f) + "\n" + edges_section(f);
  if (f.place) out += "\n" + table_section(*f.place);
  out += "\nFor a scenario\n" + sensor_lines(f);
  if (f.place) out += "For the motor's file\n" + identified_motor_line(f, name);
  return out;
}

std::string identify_toml(const std::string& name, const HallIdentity& f) {
  std::string out = as_remarks(heading(name, f)) + sensor_lines(f);
  if (f.place)
    out += "\n# For a user's firmware: the legs to connect at each code of the pins.\n" +
           as_remarks(table_section(*f.place)) + "\n# For the motor's file:\n# " +
           identified_motor_line(f, name);
  return out;
}

}  // namespace text
