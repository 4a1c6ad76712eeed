// SPDX-License-Identifier: Apache-2.0
#include "text/results/wiring_json.hpp"

#include <nlohmann/json.hpp>

#include "sixstep/base/written.hpp"
#include "sixstep/design/sheet/motion.hpp"
#include "text/escape/escape.hpp"
#include "text/results/json_words.hpp"
#include "text/results/wiring_words.hpp"

namespace text {
namespace {

using Json = nlohmann::ordered_json;

std::string bits(std::uint8_t code) {
  return {static_cast<char>('0' + (code >> 2)), static_cast<char>('0' + (code >> 1 & 1)),
          static_cast<char>('0' + (code & 1))};
}

Json commutation_json() {
  Json rows = Json::array();
  for (std::uint8_t sector = 0; sector < 6; ++sector) {
    const auto [code, high, low, floating] = analysis::commutation(sector);
    rows.push_back({{"sector", sector},
                    {"from_deg", 60 * sector},
                    {"to_deg", 60 * sector + 60},
                    {"hall", bits(code)},
                    {"high", leg_names[high]},
                    {"low", leg_names[low]},
                    {"floating", leg_names[floating]}});
  }
  return rows;
}

Json bench(const analysis::WiringBench& b) {
  return {{"voltage_V", b.voltage_V},
          {"duty", b.duty},
          {"stalled_A", b.current_A},
          {"stalled_at_full_duty_A", b.current_A / b.duty},
          {"free_s", b.free_s},
          {"watched_from_s", b.watched_from_s},
          {"turned_rad_s", b.turned_rad_s}};
}

Json theory(const analysis::WiringTheory& t) {
  Json sectors = Json::array();
  for (std::size_t n = 0; n < 6; ++n)
    sectors.push_back({{"seen", t.driven[n].seen},
                       {"source", leg_names[t.driven[n].source]},
                       {"sink", leg_names[t.driven[n].sink]},
                       {"ahead_deg", 60 * t.driven[n].ahead},
                       {"torque_Nm_A", t.torque_Nm_A[n]}});
  return {{"does", does_name(t.does)},
          {"torque_Nm_A", t.mean_Nm_A},
          {"part", t.part},
          {"least_part", t.least_part},
          {"idle_speed_part", t.idle_speed_part},
          {"idle_current_part", t.idle_current_part},
          {"rests_deg", t.rests_deg},
          {"sectors", sectors}};
}

Json measured(const analysis::WiringMeasured& m) {
  Json runs = Json::array();
  for (std::size_t n = 0; n < analysis::starts; ++n) {
    const analysis::FreeRun& run = m.runs[n];
    runs.push_back({{"start_deg", analysis::start_deg(n)},
                    {"speed_rad_s", run.speed_rad_s},
                    {"electrical_turns", run.turns},
                    {"electrical_turns_from_start", run.way_turns},
                    {"phase_rms_A", run.phase_rms_A},
                    {"peak_A", run.peak_A},
                    {"supply_A", run.supply_A},
                    {"swing_deg", run.swing_deg},
                    {"swing_Hz", run.swing_Hz},
                    {"rest_deg", run.rest_deg}});
  }
  return {{"does", does_name(m.does)},
          {"torque_Nm_A", m.torque_Nm_A},
          {"part", m.part},
          {"digest", base::written_hex(m.digest)},
          {"runs", runs}};
}

/// The new position of each wire: {"a": "b", "b": "a"}; wires that stay are omitted.
Json moves(const analysis::Moves& m, const std::string_view (&names)[3]) {
  Json out = Json::object();
  for (std::size_t n = 0; n < 3; ++n)
    if (m[n] != n) out[std::string(names[n])] = names[m[n]];
  return out;
}

Json cures(const std::vector<analysis::Cure>& all) {
  Json out = Json::array();
  for (const analysis::Cure& c : all)
    out.push_back({{"wires", c.wires()},
                   {"text", cure_text(c)},
                   {"legs", moves(c.legs, leg_names)},
                   {"pins", moves(c.pins, hall_pin_names)}});
  return out;
}

}  // namespace

std::string wiring_json(const analysis::WiringStudy& s) {
  const base::Motion motion = design::motion_of(s.subject.sheet);
  Json out = {{"sixstep", SIXSTEP_VERSION},
              {"motor", s.subject.sheet.name},
              {"commutation", commutation_json()},
              {"bench", bench(s.bench)},
              {"agreeing", s.agreeing()}};
  out["wirings"] = Json::array();
  for (const analysis::WiringCase& c : s.cases)
    out["wirings"].push_back({{"phases", phases_word(c.wiring)},
                              {"hall_lines", hall_lines_word(c.wiring)},
                              {"agrees", c.agrees()},
                              {"theory", theory(c.theory)},
                              {"measured", measured(c.measured)},
                              {"cures", cures(c.cures)}});
  out = under_names_of(motion, out);
  return visible(out.dump(2, ' ', false, Json::error_handler_t::replace), Lines::kept) + "\n";
}

}  // namespace text
