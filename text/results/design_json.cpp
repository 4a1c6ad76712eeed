// SPDX-License-Identifier: Apache-2.0
#include "text/results/design_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/written.hpp"
#include "sixstep/design/sheet/motion.hpp"
#include "sixstep/design/thesis/thesis_figures.hpp"
#include "sixstep/study/scenario/choices.hpp"
#include "text/escape/escape.hpp"
#include "text/results/design_text.hpp"
#include "text/results/json_words.hpp"

namespace text {
namespace {

using Json = nlohmann::ordered_json;
using sixstep::analysis::RobustFigure;
using sixstep::base::Motion;
using sixstep::design::DriveDesign;
using sixstep::design::LoopDesign;
using sixstep::design::LoopFigures;

Json finite(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }
Json or_null(const std::optional<double>& x) { return x ? finite(*x) : Json(nullptr); }

Json figures(const LoopFigures& f) {
  return {{"stable", f.stable},
          {"crossover_rad_s", or_null(f.crossover_rad_s)},
          {"phase_margin_rad", or_null(f.phase_rad)},
          {"gain_margin", or_null(f.gain)},
          {"delay_margin_s", or_null(f.delay_s)},
          {"bandwidth_rad_s", or_null(f.bandwidth_rad_s)},
          {"sensitivity_peak", f.sensitivity_peak},
          {"sensitivity_peak_rad_s", f.sensitivity_peak_rad_s}};
}

Json bode(const LoopDesign& loop, double period_s) {
  Json out{{"w_rad_s", Json::array()},
           {"gain", Json::array()},
           {"phase_rad", Json::array()},
           {"closed_gain", Json::array()}};
  const double from = loop.figures.crossover_rad_s.value_or(0.1 / period_s) / 100;
  for (const auto& p : sixstep::design::bode(loop.loop, period_s, from, 200)) {
    out["w_rad_s"].push_back(p.w_rad_s);
    out["gain"].push_back(p.gain);
    out["phase_rad"].push_back(p.phase_rad);
    out["closed_gain"].push_back(p.closed_gain);
  }
  return out;
}

/// At most some 500 samples, each on the grid of the period.
Json step(const LoopDesign& loop, double period_s) {
  Json out{{"t_s", Json::array()}, {"value", Json::array()}};
  const auto& samples = loop.step.samples;
  const std::size_t every = samples.size() / 500 + 1;
  for (std::size_t n = 0; n < samples.size(); n += every) {
    out["t_s"].push_back(static_cast<double>(n) * period_s);
    out["value"].push_back(samples[n]);
  }
  out["settling_s"] = finite(loop.step.settling_s);
  out["overshoot"] = loop.step.overshoot;
  return out;
}

Json loop_json(const LoopDesign& loop, const DriveDesign& d) {
  Json out{{"name", loop.name}, {"method", loop.method}};
  const Motion motion = sixstep::design::motion_of(d.motor);
  if (loop.name == "position")
    out[motion.linear ? "gain_m_s_per_mm" : "gain_rad_s_per_deg"] =
        loop.gains.d1 * motion.unit("rad/s/deg").factor;
  else
    out["gains"] = {{"d1", loop.gains.d1}, {"d0", loop.gains.d0}, {"K_i", loop.gains.d1 + loop.gains.d0}};
  out["steps"] = Json::array();
  for (const auto& s : loop.steps) {
    Json row{{"symbol", s.symbol}, {"formula", s.formula}, {"value", s.value}, {"unit", s.unit}};
    if (loop.placed)
      if (const auto printed = sixstep::design::thesis_figure(loop.name, *loop.placed, s.symbol))
        row["thesis"] = *printed;
    out["steps"].push_back(row);
  }
  out["open_loop_in_z_minus_1"] = {{"num", loop.loop.num}, {"den", loop.loop.den}};
  const bool late = d.spec.delay_periods == 1;
  out["margins"] = {{"at_once", figures(late ? loop.other : loop.figures)},
                    {"one_period_late", figures(late ? loop.figures : loop.other)}};
  out["bode"] = bode(loop, d.spec.period_s);
  out["step"] = step(loop, d.spec.period_s);
  return out;
}

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
          {"longest_period_s", d.longest_period_s}};
}

Json steps_json(const std::vector<sixstep::design::DerivationStep>& steps) {
  Json out = Json::array();
  for (const auto& s : steps)
    out.push_back({{"symbol", s.symbol}, {"formula", s.formula}, {"value", s.value}, {"unit", s.unit}});
  return out;
}

/// The speed's sensor: how old its speed is, and how fast each way of sensing lets the loop be.
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

Json robust(const std::vector<RobustFigure>& list) {
  Json out = Json::array();
  for (const RobustFigure& f : list)
    out.push_back({{"figure", f.figure},
                   {"unit", f.unit},
                   {"nominal", finite(f.nominal)},
                   {"worst", finite(f.worst)},
                   {"at", f.at},
                   {"chiefly", f.culprit},
                   {"chiefly_alone", finite(f.alone)}});
  return out;
}

Json simulated(const analysis::DesignStudy& s) {
  Json out = Json::array();
  for (const auto& c : s.outcome.comparisons)
    out.push_back({{"figure", c.figure},
                   {"unit", c.unit},
                   {"designed", c.value},
                   {"simulated", finite(c.measured)},
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
                         {"phase_margins_one_period_late", robust(s.robustness->phases)}};
  out["warnings"] = Json::array();
  for (const auto& w : s.warnings)
    out["warnings"].push_back({{"what", w.what}, {"cure", w.cure}, {"grave", w.grave}});
  return visible(out.dump(2, ' ', false, Json::error_handler_t::replace), Lines::kept) + "\n";
}

}  // namespace text
