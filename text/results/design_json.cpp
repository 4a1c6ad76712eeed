// SPDX-License-Identifier: Apache-2.0
#include "text/results/design_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/sheet/motion.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "text/escape/escape.hpp"
#include "text/escape/json_number.hpp"
#include "text/results/design_text.hpp"
#include "text/results/json_words.hpp"
#include "text/results/loop_json.hpp"

namespace text {
namespace {

using Json = nlohmann::ordered_json;
using sixstep::analysis::RobustFigure;
using sixstep::base::Motion;
using sixstep::design::DriveDesign;
using sixstep::design::LoopDesign;

Json limits(const DriveDesign& d) {
  Json headroom = Json::array();
  for (int n = 0; n <= 20; ++n) {
    const double w = d.bus_V / d.motor.K_t_Nm_A * n / 20;
    headroom.push_back({w, sixstep::design::headroom_V(d.motor, d.bus_V, d.nominal_current_A, w)});
  }
  return {{"nominal_current_A", d.nominal_current_A},
          {"nominal_current_printed", d.nominal_printed},
          {"torque_limit_Nm", d.torque_limit_Nm},
          {"current_ripple_A", d.ripple.worst_A},
          {"current_ripple_duty", d.ripple.worst_duty},
          {"continuous_above_A", d.ripple.continuous_above_A},
          {"headroom_rad_s_V", headroom},
          {"headroom_end_rad_s", d.headroom_end_rad_s},
          {"soft_braking_limit_rad_s", d.braking_limit_rad_s},
          {"commutation_limit_rad_s", d.commutation_limit_rad_s},
          {"longest_period_s", d.longest_period_s}};
}

/// The speed sensor: the delay of the measured speed, and the fastest settling with each number of edges.
Json sensing(const DriveDesign& d) {
  Json limits = Json::array();
  for (const auto& l : d.limits)
    limits.push_back({{"edges", l.sensing.edges},
                      {"lowest_speed_rad_s", l.lowest_speed_rad_s},
                      {"fastest_settling_s", or_null(l.settle_s)}});
  return {{"lowest_speed_rad_s", d.lowest_speed_rad_s},
          {"delay_s", d.lag.delay_s()},
          {"phase_margin_rad", or_null(d.loop("speed").built.phase_rad)},
          {"steps", steps_json(d.sensing)},
          {"fastest_settling", limits}};
}

/// A figure as JSON. A time may be "never"; an infinite value in another unit is null.
Json told(double x, const std::string& unit) { return unit == "s" ? figure_json(x) : finite(x); }

Json robust(const std::vector<RobustFigure>& list) {
  Json out = Json::array();
  for (const RobustFigure& f : list)
    out.push_back({{"figure", f.figure},
                   {"unit", f.unit},
                   {"nominal", told(f.nominal, f.unit)},
                   {"worst", told(f.worst, f.unit)},
                   {"at", f.at},
                   {"chiefly", f.culprit},
                   {"chiefly_alone", told(f.alone, f.unit)}});
  return out;
}

Json simulated(const analysis::DesignStudy& s) {
  Json out = Json::array();
  for (const auto& c : s.outcome.comparisons)
    out.push_back({{"figure", c.figure},
                   {"unit", c.unit},
                   {"designed", c.value},
                   {"simulated", told(c.measured, c.unit)},
                   {"source", c.source}});
  return out;
}

}  // namespace

std::string design_json(const analysis::DesignStudy& s) {
  const DriveDesign& d = s.design;
  Json out{{"sixstep", SIXSTEP_VERSION},
           {"verdict", design_verdict(s)},
           {"usable", s.usable()},
           {"motor", s.scenario.sheet.name},
           {"mode", sixstep::base::word(sixstep::study::mode_choices, d.spec.mode)},
           {"bus_V", d.bus_V},
           {"period_s", d.spec.period_s},
           {"delay_periods", d.spec.delay_periods},
           {"sample", d.spec.sampled_in_middle ? "middle" : "start"},
           {"chopping", sixstep::base::word(sixstep::study::chopping_choices, d.spec.chopping)}};
  const auto& m = d.motor;
  const Motion motion = sixstep::design::motion_of(m);
  const auto own = [&](const Json& json) { return under_names_of(motion, json); };
  out["model"] = own({{"terminal_resistance_ohm", 2 * m.machine.R_ohm},
                      {"terminal_inductance_H", 2 * m.machine.L_H},
                      {"torque_constant_Nm_A", m.K_t_Nm_A},
                      {"back_emf_peak_phase_V_s", m.K_e_V_s},
                      {"inertia_kg_m2", m.shaft.J_kg_m2},
                      {"viscous_friction_Nm_s", m.shaft.B_Nm_s}});
  if (!s.beliefs.empty()) out["wrong_beliefs"] = s.beliefs;
  out["loops"] = Json::array();
  for (const LoopDesign& loop : d.loops) out["loops"].push_back(loop_json(loop, d));
  out["limits"] = own(limits(d));
  if (!d.sensing.empty()) out["sensing"] = own(sensing(d));
  if (!s.sensorless.empty()) out["sensorless"] = {{"steps", steps_json(s.sensorless)}};
  const double of_gain = motion.unit("rad/s/deg").factor;
  if (s.position)
    out["position_gain"] = {{"estimate", s.position->estimate * of_gain},
                            {"linear", s.position->linear * of_gain},
                            {"overshoots_at", s.position->overshoots * of_gain},
                            {"runs", s.position->runs}};
  out["simulated"] = simulated(s);
  out["digest"] = sixstep::base::written_hex(s.outcome.digest);
  if (s.robustness)
    out["tolerances"] = {{"motors", s.robustness->runs},
                         {"figures", robust(s.robustness->figures)},
                         {d.spec.sampled_in_middle ? "phase_margins_one_and_a_half_periods_late"
                                                   : "phase_margins_one_period_late",
                          robust(s.robustness->phases)}};
  out["warnings"] = Json::array();
  for (const auto& w : s.warnings)
    out["warnings"].push_back({{"what", w.what}, {"cure", w.cure}, {"grave", w.grave}});
  return visible(out.dump(2, ' ', false, Json::error_handler_t::replace), Lines::kept) + "\n";
}

}  // namespace text
