// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "text/escape/escape.hpp"
#include "text/results/hall_words.hpp"
#include "text/results/identify_text.hpp"
#include "text/results/interval_json.hpp"

namespace text {
namespace {

using Json = nlohmann::ordered_json;

Json wires_json(const analysis::HallWires& w) {
  return {{"spacing_deg", w.spaced_60 ? 60 : 120},
          {"hall_lines", probes_word(w.probes)},
          {"hall_inverted", inverted_word(w.inverted)}};
}

Json place_json(const analysis::IdentifiedPlace& p) {
  Json out = {{"probability", p.probability},
              {"order_probability", p.order_probability},
              {"turned", p.forward ? "forward" : "backward"}};
  out["wires"] = Json::array();
  for (const analysis::HallWires& w : p.wires) out["wires"].push_back(wires_json(w));
  out["codes_of_sectors"] = Json::array();
  for (const std::uint8_t code : p.codes) out["codes_of_sectors"].push_back(code_word(code));
  out["commutation"] = Json::array();
  for (const analysis::CodePair& row : analysis::commutation_of(p.codes))
    out["commutation"].push_back({{"code", code_word(row.code)},
                                  {"sector", row.sector},
                                  {"high", std::string(1, leg_word(row.pair.source))},
                                  {"low", std::string(1, leg_word(row.pair.sink))}});
  out["offset_deg"] = interval_json(p.offset_deg);
  out["hysteresis_deg"] = p.hysteresis_deg ? interval_json(*p.hysteresis_deg) : Json(nullptr);
  out["edges_at_turns"] = p.at_turns;
  out["delay_s"] = p.delay_s ? interval_json(*p.delay_s) : Json(nullptr);
  out["flux_linkage_Vs"] = interval_json(p.flux_linkage_Vs);
  out["explained"] = p.explained;
  return out;
}

}  // namespace

std::string identify_json(const std::string& name, const analysis::HallIdentity& f) {
  Json out = {{"sixstep", SIXSTEP_VERSION},
              {"log", name},
              {"rows", f.rows},
              {"seconds", f.seconds},
              {"edges_forward", f.forward},
              {"edges_backward", f.backward},
              {"glitches", f.glitches},
              {"sectors_skipped", f.skipped},
              {"edges_left_out", f.left_out},
              {"voltage_readings_left_out", f.voltages_left_out},
              {"edges_unused", f.unused}};
  out["codes_never_seen"] = {code_word(f.mask), code_word(static_cast<std::uint8_t>(f.mask ^ 7))};
  out["codes_never_seen_probability"] = f.mask_probability;
  out["edges"] = Json::array();
  for (const analysis::IdentifiedEdge& e : f.edges)
    out["edges"].push_back({{"before", code_word(e.before)},
                            {"after", code_word(e.after)},
                            {"own_deg", interval_json(e.own_deg)},
                            {"seen", e.seen}});
  out["jitter_deg"] = interval_json(f.jitter_deg);
  out["place"] = f.place ? place_json(*f.place) : Json(nullptr);
  return visible(out.dump(2, ' ', false, Json::error_handler_t::replace), Lines::kept) + "\n";
}

}  // namespace text
