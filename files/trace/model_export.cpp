// SPDX-License-Identifier: Apache-2.0
#include "files/trace/model_export.hpp"

#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "files/text_file.hpp"
#include "files/trace/mat_file.hpp"
#include "sixstep/base/angle.hpp"
#include "sixstep/design/thesis/thesis_models.hpp"

namespace files {
namespace {

using Json = nlohmann::ordered_json;

const std::vector<std::string> phase_states{"i_a_A", "i_b_A", "i_c_A", "w_m_rad_s", "theta_m_rad"},
    phase_inputs{"u_an_V", "u_bn_V", "u_cn_V", "T_load_Nm"},
    terminal_states{"i_a_A", "i_b_A", "w_m_rad_s", "theta_m_rad"},
    terminal_inputs{"u_ab_V", "u_bc_V", "T_load_Nm"};

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
void put(MatFile& file, const char* name, const sixstep::design::Matrix<Rows, Columns>& m) {
  std::vector<double> values;
  for (std::size_t c = 0; c < Columns; ++c)
    for (std::size_t r = 0; r < Rows; ++r) values.push_back(m[r][c]);
  file.numbers(name, std::move(values), Rows, Columns);
}

}  // namespace

std::string models_json(const ModelPoint& p) {
  const sixstep::plant::Machine& machine = p.motor.machine;
  const sixstep::plant::Shaft& shaft = p.motor.shaft;
  Json out{{"sixstep", SIXSTEP_VERSION}, {"parameters", Json::object()}};
  for (const auto& [name, value] : parameters(p)) out["parameters"][name] = value;
  out["phase_voltage"] = space_json(sixstep::design::phase_voltage_model(machine, shaft, angle_of(p)),
                                    phase_states, phase_inputs);
  out["terminal_voltage"] = space_json(sixstep::design::terminal_voltage_model(machine, shaft, angle_of(p)),
                                       terminal_states, terminal_inputs);
  return out.dump(2) + "\n";
}

base::Result<std::string> models_mat(const ModelPoint& p) {
  if (!matio()) return base::Problem{"--models", "", matio().problems().front().limit, "name a .json file"};
  const base::Problem no_room{"--models", "", "cannot be made: no temporary file", "make room in TMPDIR"};
  const Scratch scratch;
  if (!scratch.made()) return no_room;
  {
    MatFile file(*matio(), scratch.path(), MatVersion::v5);
    const auto phase = sixstep::design::phase_voltage_model(p.motor.machine, p.motor.shaft, angle_of(p));
    const auto terminal =
        sixstep::design::terminal_voltage_model(p.motor.machine, p.motor.shaft, angle_of(p));
    put(file, "phase_A", phase.A);
    put(file, "phase_B", phase.B);
    file.text("phase_states", joined(phase_states));
    file.text("phase_inputs", joined(phase_inputs));
    put(file, "terminal_A", terminal.A);
    put(file, "terminal_B", terminal.B);
    file.text("terminal_states", joined(terminal_states));
    file.text("terminal_inputs", joined(terminal_inputs));
    for (const auto& [name, value] : parameters(p)) file.numbers(name, {value}, 1, 1);
    if (!file.close()) return no_room;
  }
  return read_text(scratch.path());
}

}  // namespace files
