// SPDX-License-Identifier: Apache-2.0
#include "text/motor/foreign_keys.hpp"

namespace text {
namespace {

constexpr double rms_of_peak = 0.70710678118654752;

// The frame of R is "phase", because the firmware computes u = R i with the voltage u and current i of a
// phase.
constexpr ForeignKey vesc[] = {
    {"si_motor_poles", "poles"},
    {"foc_motor_r", "resistance_ohm", 1, "phase"},
    {"foc_motor_flux_linkage", "flux_linkage_mWb", 1e3},
};
constexpr ForeignKey odrive[] = {
    {"pole_pairs", "pole_pairs"},
    {"phase_resistance", "resistance_ohm", 1, "phase"},
    {"torque_constant", "torque_constant_Nm_A", 1, "peak"},
};
constexpr ForeignKey moteus[] = {
    {"motor.poles", "poles"},
    {"motor.resistance_ohm", "resistance_ohm", 1, "phase"},
    {"motor.Kv", "speed_constant_rpm_V", 1, "line-peak"},
};
constexpr ForeignKey simple_foc[] = {
    {"pp", "pole_pairs"},
    {"R", "resistance_ohm", 1, "phase", "resistance", "terminal",
     "the constructor's comment states a phase, the library's page on testing parameters states phase to phase"},
    {"KV", "speed_constant_rpm_V", 1, "line-peak", "kv", "six-step",
     "the library computes with the line-to-line peak, sheets of motors often mean the six-step constant, and the library's page suggests "
     "50 to 70 % more than the sheet's value"},
};
constexpr ForeignKey matlab[] = {
    {"p", "pole_pairs"},
    {"Rs", "resistance_ohm", 1, "phase"},
    {"FluxPM", "flux_linkage_mWb", 1e3},
    {"Ke", "back_emf_constant_V_krpm", 1, "line-peak"},
    {"J", "inertia_kgm2"},
    {"B", "viscous_friction_Nm_s"},
    {"I_rated", "nominal_current_A", rms_of_peak, "rms"},
    {"N_max", "max_speed_rpm"},
};

constexpr ForeignTool tools[] = {
    {ForeignKind::vesc, "VESC Tool", {"", "", "foc_motor_l", "foc_motor_ld_lq_diff"}, vesc},
    {ForeignKind::odrive, "ODrive", {"", "", "phase_inductance", ""}, odrive},
    {ForeignKind::moteus, "moteus", {"motor.inductance_d_H", "motor.inductance_q_H", "", ""}, moteus},
    {ForeignKind::simple_foc, "SimpleFOC", {"Ld", "Lq", "", ""}, simple_foc},
    {ForeignKind::matlab, "MATLAB", {"Ld", "Lq", "", ""}, matlab},
};

}  // namespace

const ForeignTool& foreign_tool(ForeignKind kind) {
  for (const ForeignTool& tool : tools)
    if (tool.kind == kind) return tool;
  return tools[0];
}

}  // namespace text
