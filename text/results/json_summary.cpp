// SPDX-License-Identifier: Apache-2.0
#include "text/results/json_summary.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <optional>

#include "sixstep/base/written.hpp"
#include "sixstep/study/run/run.hpp"
#include "sixstep/study/scenario/own_numbers.hpp"
#include "text/escape/escape.hpp"
#include "text/escape/json_number.hpp"
#include "text/results/core_text.hpp"

namespace text {
namespace {

using Json = nlohmann::ordered_json;

Json verdicts(const study::Outcome& outcome) {
  Json list = Json::array();
  for (const study::Verdict& v : outcome.verdicts)
    list.push_back({{"figure", v.figure},
                    {"unit", v.unit},
                    {"measured", figure_json(v.measured)},
                    {"min", or_null(v.min)},
                    {"max", or_null(v.max)},
                    {"ok", v.ok}});
  return list;
}

Json comparisons(const study::Outcome& outcome) {
  Json list = Json::array();
  for (const study::ComparisonResult& c : outcome.comparisons) {
    Json& row = list.emplace_back(Json{{"figure", c.figure},
                                       {"unit", c.unit},
                                       {"measured", figure_json(c.measured)},
                                       {"value", c.value},
                                       {"source", c.source}});
    if (!c.uncertainty) continue;
    row["uncertainty"] = *c.uncertainty;
    row["verdict"] = c.fails                                                  ? "fails"
                     : !(c.beyond() >= 0.0) || !std::isfinite(*c.uncertainty) ? "none"
                     : c.beyond() > 0.0                                       ? "beyond"
                                                                              : "within";
  }
  return list;
}

Json gains(const study::Outcome& outcome) {
  Json list = Json::array();
  for (const study::LoopGains& g : outcome.gains)
    list.push_back({{"loop", g.loop}, {"d1", g.d1}, {"d0", g.d0}, {"origin", g.origin}});
  return list;
}

Json own(const study::Own& own) {
  Json numbers = Json::array();
  for (const study::UsedNumber& number : study::used_numbers(own))
    numbers.push_back({{"name", number.is->name},
                       {"value", number.value},
                       {"unit", number.is->unit},
                       {"preset", number.preset}});
  return {{"name", own.loaded->name}, {"numbers", numbers}};
}

Json devices(const study::Outcome& outcome) {
  Json list = Json::array();
  for (const study::DeviceLoss& d : outcome.devices)
    list.push_back({{"device", d.device},
                    {"conduction_W", d.conduction_W},
                    {"turn_on_W", d.turn_on_W},
                    {"turn_off_W", d.turn_off_W},
                    {"diode_W", d.diode_W},
                    {"recovery_W", d.recovery_W},
                    {"junction_degC", d.junction_degC > 0 ? Json(d.junction_degC) : Json(nullptr)}});
  return list;
}

Json energy(const sixstep::plant::EnergyBook& e) {
  return {{"supplied_J", e.supplied},
          {"copper_J", e.copper},
          {"devices_J", e.devices},
          {"magnetic_J", e.magnetic},
          {"air_gap_J", e.air_gap},
          {"friction_J", e.friction},
          {"iron_J", e.iron},
          {"load_J", e.load},
          {"kinetic_J", e.kinetic},
          {"brake_resistor_J", e.brake_resistor},
          {"moved_J", e.moved},
          {"scale_J", e.scale},
          {"electrical_residual", e.electrical_residual},
          {"mechanical_residual", e.mechanical_residual}};
}

Json laws(const sixstep::plant::Laws& l) {
  return {{"current_sum_A", l.current_sum_A},
          {"reverse_diode_A", l.reverse_diode_A},
          {"floating_current_A", l.floating_current_A}};
}

Json trip(const study::Trip& t) {
  return {{"at_s", t.at_s},
          {"reasons", t.reasons},
          {"hall_line", t.hall_line > 0 ? Json(t.hall_line) : Json(nullptr)}};
}

Json events(const study::Outcome& outcome) {
  Json counts = Json::object();
  for (const study::EventCount& e : outcome.events) counts[e.event] = e.count;
  return counts;
}

Json interrupt(const sixstep::rig::InterruptTimes& t) {
  return {{"count", t.count},      {"sum_cycles", t.sum},        {"least_cycles", t.least},
          {"most_cycles", t.most}, {"bin_cycles", t.bin_cycles}, {"bins", t.bin}};
}

Json chip(const study::ChipReport& c) {
  return {{"name", c.chip},
          {"clock_Hz", c.clock_Hz},
          {"period_s", c.period_s},
          {"periods", c.times.periods},
          {"conversions", c.times.conversions},
          {"latest_edge_s", c.latest_edge_s},
          {"faults", text::chip_faults(c)},
          {"control", interrupt(c.times.control)},
          {"hall", interrupt(c.times.hall)}};
}

}  // namespace

std::string json_summary(const study::Scenario& scenario, const study::Outcome& outcome) {
  Json summary = {{"sixstep", SIXSTEP_VERSION},
                  {"title", scenario.title},
                  {"motor", scenario.sheet.name},
                  {"passed", outcome.passed()},
                  {"fault", outcome.fault ? Json(base::to_string(*outcome.fault)) : Json(nullptr)},
                  {"trip", outcome.trip ? trip(*outcome.trip) : Json(nullptr)},
                  {"duration_s", scenario.duration_s},
                  {"complete", !study::cut_short(scenario, outcome)},
                  {"simulated_s", outcome.simulated_s},
                  {"segments", outcome.segments},
                  {"digest", base::written_hex(outcome.digest)}};
  if (!outcome.notes.empty()) summary["notes"] = outcome.notes;
  if (!outcome.remarks.empty()) summary["remarks"] = outcome.remarks;
  if (outcome.core) summary["core"] = {{"name", outcome.core->core}, {"calls", outcome.core->calls}};
  if (outcome.chip) summary["chip"] = chip(*outcome.chip);
  summary["require"] = verdicts(outcome);
  summary["compare"] = comparisons(outcome);
  summary["gains"] = gains(outcome);
  if (scenario.control.own.loaded) summary["own"] = own(scenario.control.own);
  summary["energy"] = outcome.energy ? energy(*outcome.energy) : Json(nullptr);
  summary["devices"] = devices(outcome);
  summary["laws"] = outcome.laws ? laws(*outcome.laws) : Json(nullptr);
  summary["events"] = events(outcome);
  // A title may contain invalid UTF-8. The bytes are replaced, because the conversion must not throw.
  return visible(summary.dump(2, ' ', false, Json::error_handler_t::replace), Lines::kept) + "\n";
}

}  // namespace text
