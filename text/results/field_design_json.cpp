// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/scenario/choices.hpp"
#include "text/escape/escape.hpp"
#include "text/escape/json_number.hpp"
#include "text/results/field_design_text.hpp"
#include "text/results/loop_json.hpp"

namespace text {

std::string field_design_json(const sixstep::analysis::FieldStudy& f) {
  using Json = nlohmann::ordered_json;
  const sixstep::design::DriveDesign& d = f.design;
  const sixstep::design::FieldMachine& m = f.machine;
  Json out{{"sixstep", SIXSTEP_VERSION},
           {"verdict", field_design_verdict(f)},
           {"usable", f.usable()},
           {"motor", f.scenario.sheet.name},
           {"drive", "field-oriented"},
           {"mode", sixstep::base::word(sixstep::study::mode_choices, d.spec.mode)},
           {"bus_V", d.bus_V},
           {"period_s", d.spec.period_s},
           {"delay_periods", d.spec.delay_periods},
           {"sample", d.spec.sampled_in_middle ? "middle" : "start"}};
  out["model"] = {{"phase_resistance_ohm", m.R_ohm},
                  {"d_axis_inductance_H", m.L_d_H},
                  {"q_axis_inductance_H", m.L_q_H},
                  {"back_emf_fundamental_phase_V_s", m.magnet_V_s},
                  {"pole_pairs", m.pole_pairs},
                  {"torque_per_q_Nm_A", torque_per_q_A(m)},
                  {"inertia_kg_m2", d.motor.shaft.J_kg_m2},
                  {"viscous_friction_Nm_s", d.motor.shaft.B_Nm_s}};
  if (!f.beliefs.empty()) out["wrong_beliefs"] = f.beliefs;
  out["loops"] = Json::array();
  for (const sixstep::design::LoopDesign& loop : d.loops) out["loops"].push_back(loop_json(loop, d));
  out["axes"] = steps_json(f.axes);
  out["limits"] = steps_json(f.limits);
  if (!d.sensing.empty())
    out["sensing"] = {{"lowest_speed_rad_s", d.lowest_speed_rad_s},
                      {"delay_s", d.lag.delay_s()},
                      {"phase_margin_rad", or_null(d.loop("speed").built.phase_rad)},
                      {"steps", steps_json(d.sensing)}};
  out["warnings"] = Json::array();
  for (const auto& w : f.warnings)
    out["warnings"].push_back({{"what", w.what}, {"cure", w.cure}, {"grave", w.grave}});
  return visible(out.dump(2, ' ', false, Json::error_handler_t::replace), Lines::kept) + "\n";
}

}  // namespace text
