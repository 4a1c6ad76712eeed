// SPDX-License-Identifier: Apache-2.0
// Other keys of a motor file: the numbered lines of maxon's sheets, and the same values in other units.
#pragma once
#include "sixstep/base/angle.hpp"
#include "sixstep/base/describe.hpp"

namespace sixstep::design::spellings {

using base::Spelling;

/// A key of linear motors.
constexpr Spelling linear(std::string_view key, std::string_view unit, int ten = 0, double factor = 1.0) {
  return {.key = key, .ten = ten, .unit = unit, .factor = factor, .linear = true};
}

/// A line of maxon's sheets, whose numbers and frames have not changed over the years. `meaning` replaces the
/// meaning of a key with several possible frames.
constexpr Spelling line(std::string_view key, std::string_view source, std::string_view frame = "",
                        std::string_view meaning = "") {
  return {.key = key, .frame = frame, .source = source, .meaning = meaning};
}

inline constexpr Spelling nominal_voltage[] = {line("line_1_nominal_voltage_V", "data sheet, line 1")};
inline constexpr Spelling no_load_speed[] = {line("line_2_no_load_speed_rpm", "data sheet, line 2"),
                                             linear("no_load_speed_m_s", "m/s", 0, base::rpm_per_rad_s)};
inline constexpr Spelling no_load_current[] = {
    line("line_3_no_load_current_mA", "data sheet, line 3"),
    {.key = "idle_current_A", .ten = 3, .unit = "A"},
};
inline constexpr Spelling no_load_voltage[] = {{.key = "idle_voltage_V"}};
inline constexpr Spelling nominal_speed[] = {line("line_4_nominal_speed_rpm", "data sheet, line 4"),
                                             linear("nominal_speed_m_s", "m/s", 0, base::rpm_per_rad_s)};
inline constexpr Spelling nominal_torque[] = {line("line_5_nominal_torque_mNm", "data sheet, line 5"),
                                              {.key = "nominal_torque_Nm", .ten = 3, .unit = "Nm"},
                                              linear("nominal_force_N", "N", 3)};
inline constexpr Spelling nominal_current[] = {line(
    "line_6_nominal_current_A", "data sheet, line 6", "terminal",
    "greatest continuous current: direct current through the driven pair, in at one terminal and out at another")};
inline constexpr Spelling stall_torque[] = {line("line_7_stall_torque_mNm", "data sheet, line 7"),
                                            {.key = "stall_torque_Nm", .ten = 3, .unit = "Nm"},
                                            linear("stall_force_N", "N", 3)};
inline constexpr Spelling stall_current[] = {line("line_8_stall_current_A", "data sheet, line 8")};
inline constexpr Spelling max_efficiency[] = {line("line_9_max_efficiency_percent", "data sheet, line 9")};
inline constexpr Spelling resistance[] = {
    line("line_10_terminal_resistance_ohm", "data sheet, line 10", "terminal",
         "winding resistance between two terminals"),
    {.key = "resistance_mohm", .ten = -3, .unit = "mohm"},
};
inline constexpr Spelling inductance[] = {
    line("line_11_terminal_inductance_mH", "data sheet, line 11", "terminal",
         "winding inductance between two terminals"),
    {.key = "inductance_uH", .ten = -3, .unit = "uH"},
};
inline constexpr Spelling d_axis_inductance[] = {{.key = "d_axis_inductance_uH", .ten = -3, .unit = "uH"}};
inline constexpr Spelling q_axis_inductance[] = {{.key = "q_axis_inductance_uH", .ten = -3, .unit = "uH"}};
inline constexpr Spelling torque_constant[] = {
    line("line_12_torque_constant_mNm_A", "data sheet, line 12", "terminal")};
inline constexpr Spelling speed_constant[] = {
    line("line_13_speed_constant_rpm_V", "data sheet, line 13", "six-step",
         "speed per volt of the mean voltage in six-step operation")};
inline constexpr Spelling speed_torque_gradient[] = {
    line("line_14_speed_torque_gradient_rpm_mNm", "data sheet, line 14")};
inline constexpr Spelling mechanical_time_constant[] = {
    line("line_15_mechanical_time_constant_ms", "data sheet, line 15")};
inline constexpr Spelling inertia[] = {line("line_16_rotor_inertia_gcm2", "data sheet, line 16"),
                                       {.key = "inertia_kgcm2", .ten = 3, .unit = "kg cm2"},
                                       {.key = "inertia_kgm2", .ten = 7, .unit = "kg m2"},
                                       linear("mass_kg", "kg", 7)};
inline constexpr Spelling inertia_with_brake[] = {
    {.key = "inertia_with_brake_kgcm2", .ten = 3, .unit = "kg cm2"},
    {.key = "inertia_with_brake_kgm2", .ten = 7, .unit = "kg m2"},
};
inline constexpr Spelling flux_linkage[] = {{.key = "flux_linkage_Wb", .ten = 3, .unit = "Wb"}};
inline constexpr Spelling housing_ambient[] = {
    line("line_17_thermal_resistance_housing_ambient_K_W", "data sheet, line 17")};
inline constexpr Spelling winding_housing[] = {
    line("line_18_thermal_resistance_winding_housing_K_W", "data sheet, line 18")};
inline constexpr Spelling winding_time[] = {
    line("line_19_thermal_time_constant_winding_s", "data sheet, line 19")};
inline constexpr Spelling motor_time[] = {
    line("line_20_thermal_time_constant_motor_s", "data sheet, line 20")};
inline constexpr Spelling winding_temperature[] = {
    line("line_22_max_winding_temperature_degC", "data sheet, line 22")};
inline constexpr Spelling max_speed[] = {line("line_23_max_speed_rpm", "data sheet, line 23"),
                                         linear("max_speed_m_s", "m/s", 0, base::rpm_per_rad_s)};

inline constexpr Spelling second_no_load_speed[] = {
    linear("second_no_load_speed_m_s", "m/s", 0, base::rpm_per_rad_s)};
inline constexpr Spelling torque_per_A[] = {linear("force_constant_N_A", "N/A")};
inline constexpr Spelling back_emf_per_speed[] = {
    linear("back_emf_V_s_m", "V s/m", 0, 1e3 / base::rpm_per_rad_s)};
inline constexpr Spelling viscous[] = {linear("viscous_friction_N_s_m", "N s/m")};
inline constexpr Spelling coulomb[] = {linear("coulomb_friction_N", "N", 3)};
inline constexpr Spelling iron_viscous[] = {linear("iron_viscous_N_s_m", "N s/m")};
inline constexpr Spelling iron_coulomb[] = {linear("iron_coulomb_N", "N", 3)};
inline constexpr Spelling cogging[] = {linear("cogging_N", "N", 3)};

inline constexpr Spelling pole_pairs[] = {line("line_29_number_of_pole_pairs", "data sheet, line 29")};

}  // namespace sixstep::design::spellings
