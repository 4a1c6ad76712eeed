// SPDX-License-Identifier: Apache-2.0
#include "files/trace/model_export.hpp"

#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "files/trace/mat5.hpp"
#include "sixstep/base/angle.hpp"
#include "sixstep/design/sheet/motion.hpp"
#include "sixstep/design/thesis/thesis_models.hpp"

namespace files {
namespace {

using Json = nlohmann::ordered_json;

const std::vector<std::string> phase_states{"i_a_A", "i_b_A", "i_c_A", "w_m_rad_s", "theta_m_rad"},
    phase_inputs{"u_an_V", "u_bn_V", "u_cn_V", "T_load_Nm"},
    terminal_states{"i_a_A", "i_b_A", "w_m_rad_s", "theta_m_rad"},
    terminal_inputs{"u_ab_V", "u_bc_V", "T_load_Nm"};

/// Symbols of a rotary motor, and the symbols that replace them for a linear motor.
constexpr sixstep::base::LinearWord linear_symbols[] = {
    {"w_m_rad_s", "v_m_s"},    {"theta_m_rad", "x_m"},
    {"T_load_Nm", "F_load_N"}, {"pole_pairs", "pole_pairs_per_m"},
    {"K_e_V_s", "K_e_V_s_m"},  {"K_t_Nm_A", "K_f_N_A"},
    {"J_kg_m2", "m_kg"},       {"B_Nm_s", "B_N_s_m"},
};

std::string symbol_of(const ModelPoint& p, const std::string& turning) {
  if (!sixstep::design::motion_of(p.motor).linear) return turning;
  for (const sixstep::base::LinearWord& word : linear_symbols)
    if (word.turning == turning) return std::string(word.linear);
  return turning;
}

std::vector<std::string> symbols(const ModelPoint& p, std::vector<std::string> names) {
  for (std::string& name : names) name = symbol_of(p, name);
  return names;
}

sixstep::base::MechanicalAngle angle_of(const ModelPoint& p) {
  const double rad = p.electrical_deg * sixstep::base::pi / 180;
  return sixstep::base::PolePairs{p.motor.machine.pole_pairs}.mechanical(sixstep::base::ElectricalAngle{rad});
}

std::vector<std::pair<std::string, double>> parameters(const ModelPoint& p) {
  const auto& m = p.motor;
  return {{"theta_e_deg", p.electrical_deg},
          {"theta_m_rad", angle_of(p).rad},
          {"pole_pairs", m.machine.pole_pairs},
          {"R_s_ohm", m.machine.R_ohm},
          {"L_s_H", m.machine.L_H},
          {"K_e_V_s", m.machine.K_e_V_s},
          {"K_t_Nm_A", m.K_t_Nm_A},
          {"J_kg_m2", m.shaft.J_kg_m2},
          {"B_Nm_s", m.shaft.B_Nm_s}};
}

template <class Space>
Json space_json(const Space& s, const std::vector<std::string>& states,
                const std::vector<std::string>& inputs) {
  return {{"A", s.A}, {"B", s.B}, {"states", states}, {"inputs", inputs}};
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

template <std::size_t Rows, std::size_t Columns>
std::string numbers(const char* name, const sixstep::design::Matrix<Rows, Columns>& m) {
  std::vector<double> values;
  for (std::size_t c = 0; c < Columns; ++c)
    for (std::size_t r = 0; r < Rows; ++r) values.push_back(m[r][c]);
  return mat5_numbers(name, values, Rows, Columns);
}

}  // namespace

std::string models_json(const ModelPoint& p) {
  const sixstep::plant::Machine& machine = p.motor.machine;
  const sixstep::plant::Shaft& shaft = p.motor.shaft;
  Json out{{"sixstep", SIXSTEP_VERSION}, {"parameters", Json::object()}};
  for (const auto& [name, value] : parameters(p)) out["parameters"][symbol_of(p, name)] = value;
  if (!p.motor.left_to_a_run.empty()) out["left_to_a_run"] = p.motor.left_to_a_run;
  out["phase_voltage"] = space_json(sixstep::design::phase_voltage_model(machine, shaft, angle_of(p)),
                                    symbols(p, phase_states), symbols(p, phase_inputs));
  out["terminal_voltage"] = space_json(sixstep::design::terminal_voltage_model(machine, shaft, angle_of(p)),
                                       symbols(p, terminal_states), symbols(p, terminal_inputs));
  return out.dump(2) + "\n";
}

std::string models_mat(const ModelPoint& p) {
  const auto phase = sixstep::design::phase_voltage_model(p.motor.machine, p.motor.shaft, angle_of(p));
  const auto terminal = sixstep::design::terminal_voltage_model(p.motor.machine, p.motor.shaft, angle_of(p));
  std::string file = mat5_begin() + numbers("phase_A", phase.A) + numbers("phase_B", phase.B) +
                     mat5_text("phase_states", joined(symbols(p, phase_states))) +
                     mat5_text("phase_inputs", joined(symbols(p, phase_inputs))) +
                     numbers("terminal_A", terminal.A) + numbers("terminal_B", terminal.B) +
                     mat5_text("terminal_states", joined(symbols(p, terminal_states))) +
                     mat5_text("terminal_inputs", joined(symbols(p, terminal_inputs)));
  if (!p.motor.left_to_a_run.empty()) file += mat5_text("left_to_a_run", p.motor.left_to_a_run);
  for (const auto& [name, value] : parameters(p)) file += mat5_numbers(symbol_of(p, name), {&value, 1}, 1, 1);
  return file;
}

}  // namespace files
