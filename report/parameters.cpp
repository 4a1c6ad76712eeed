// SPDX-License-Identifier: Apache-2.0
#include "report/parameters.hpp"

#include <fmt/format.h>

#include "report/figures.hpp"
#include "report/html.hpp"
#include "sixstep/base/linear.hpp"

namespace report {
namespace {

using sixstep::base::Quantity;

constexpr const char* sheet_head =
    "<table><thead><tr><th>Data sheet</th><th "
    "class=\"num\">Value</th><th>Frame</th><th>Source</th></tr></thead><tbody>\n";
constexpr const char* model_head =
    "<table><thead><tr><th>Model</th><th "
    "class=\"num\">Value</th><th>Frame</th><th>From</th></tr></thead><tbody>\n";

std::string row(std::string_view name, const std::string& value, std::string_view frame,
                std::string_view source) {
  return fmt::format(
      "<tr><th scope=\"row\">{}</th><td class=\"num\">{}</td><td>{}</td><td class=\"source\">{}</td></tr>\n",
      name, escaped(value), escaped(frame), with_subscripts(source));
}

/// A row with the quantity in the sheet's unit; the prefix is not changed.
std::string row(std::string_view name, const Quantity& q, std::string_view unit,
                std::string_view frame = "") {
  return row(name, plain(q.value, 7, true) + "\u00a0" + std::string(unit), q.frame.empty() ? frame : q.frame,
             q.source);
}

/// A row with the quantity. The unit is linear (N, m, kg) if the sheet's key is a linear motor's.
std::string row(std::string_view name, const std::optional<Quantity>& q, std::string_view unit,
                std::string_view frame = "") {
  if (!q) return "";
  const sixstep::base::LinearUnit linear = sixstep::base::in_linear(unit);
  const std::string_view key = q->key;
  const bool moving = key.ends_with("_N") || key.ends_with("_N_A") || key.ends_with("_m_s") ||
                      key.ends_with("_kg") || key.ends_with("_N_s_m");
  if (!moving) return row(name, *q, unit, frame);
  Quantity shown = *q;
  shown.value *= linear.factor;
  return row(sixstep::base::linear_words(std::string(name)), shown, linear.linear, frame);
}

std::string shape_words(const sixstep::design::MotorModel& m) {
  if (m.shape_is_table) return "a table; closed forms use a sine of the same torque constant";
  if (m.machine.back_emf == sixstep::plant::BackEmf::sine) return "sine";
  return fmt::format("trapezoid, {}° flat", plain(m.machine.flat_deg, 4, true));
}

}  // namespace

std::string sheet_section(const sixstep::design::Sheet& s) {
  std::string html = sheet_head;
  html += row("Nominal voltage U<sub>N</sub>", s.nominal_voltage_V, "V");
  html += row("Pole pitch τ", s.pole_pitch_mm, "mm");
  html += row("Resistance R", s.resistance_ohm, "Ω");
  html += row("Inductance L", s.inductance_mH, "mH");
  html += row("Inductance L<sub>d</sub>", s.d_axis_inductance_mH, "mH");
  html += row("Inductance L<sub>q</sub>", s.q_axis_inductance_mH, "mH");
  html += row("Saturation I<sub>sat</sub>", s.saturation_current_A, "A");
  html += row("Torque constant K<sub>t</sub>", s.torque_constant_mNm_A, "mNm/A", "terminal");
  html += row("Torque constant K<sub>t</sub>", s.torque_constant_Nm_A, "Nm/A");
  html += row("Back-EMF constant", s.back_emf_constant_V_krpm, "V/krpm");
  html += row("Flux linkage ψ<sub>f</sub>", s.flux_linkage_mWb, "mWb", "phase");
  html += row("Back-EMF constant", s.back_emf_mV_s, "mV s", "phase, mechanical");
  html += row("Flux density in the air gap", s.flux_density_T, "T");
  html += row("Active length", s.active_length_mm, "mm");
  html += row("Air gap, radius", s.air_gap_radius_mm, "mm");
  html += row("Rotor inertia J", s.inertia_gcm2, "g cm²");
  html += row("Inertia with brake", s.inertia_with_brake_gcm2, "g cm²");
  html += row("Rotor, outer radius", s.rotor_radius_mm, "mm");
  html += row("Rotor, inner radius", s.rotor_inner_radius_mm, "mm");
  html += row("Rotor, length", s.rotor_length_mm, "mm");
  html += row("Rotor, density", s.rotor_density_kg_m3, "kg/m³");
  html += row("Viscous friction B", s.viscous_friction_Nm_s, "Nm s", "mechanical");
  html += row("Coulomb friction", s.coulomb_friction_mNm, "mNm");
  html += row("Iron drag, viscous", s.iron_viscous_Nm_s, "Nm s", "mechanical");
  html += row("Iron drag, dry", s.iron_coulomb_mNm, "mNm");
  html += row("No-load voltage", s.no_load_voltage_V, "V", "terminal");
  html += row("No-load speed", s.no_load_speed_rpm, "rpm", "mechanical");
  html += row("No-load current", s.no_load_current_mA, "mA", "terminal");
  html += row("Second no-load voltage", s.second_no_load_voltage_V, "V", "terminal");
  html += row("Second no-load speed", s.second_no_load_speed_rpm, "rpm", "mechanical");
  html += row("Second no-load current", s.second_no_load_current_mA, "mA", "terminal");
  html += row("Nominal speed", s.nominal_speed_rpm, "rpm", "mechanical");
  html += row("Nominal torque", s.nominal_torque_mNm, "mNm");
  html += row("Nominal current", s.nominal_current_A, "A", "terminal");
  html += row("Stall torque", s.stall_torque_mNm, "mNm");
  html += row("Stall current", s.stall_current_A, "A", "terminal");
  html += row("Speed constant", s.speed_constant_rpm_V, "rpm/V", "terminal");
  html += row("Largest efficiency", s.max_efficiency_percent, "%");
  html += row("Speed/torque gradient", s.speed_torque_gradient_rpm_mNm, "rpm/mNm", "mechanical");
  html += row("Mechanical time constant τ<sub>m</sub>", s.mechanical_time_constant_ms, "ms");
  html += row("Electrical time constant τ<sub>e</sub>", s.electrical_time_constant_ms, "ms");
  html += row("Largest speed", s.max_speed_rpm, "rpm", "mechanical");
  html += row("Thermal resistance, winding to housing", s.thermal_resistance_winding_housing_K_W, "K/W");
  html += row("Thermal resistance, housing to ambient", s.thermal_resistance_housing_ambient_K_W, "K/W");
  html += row("Thermal time constant of the winding", s.thermal_time_constant_winding_s, "s");
  html += row("Thermal time constant of the motor", s.thermal_time_constant_motor_s, "s");
  html += row("Largest winding temperature", s.max_winding_temperature_degC, "°C");
  return html + "</tbody></table>\n";
}

std::string model_section(const sixstep::design::MotorModel& m) {
  std::string html = model_head;
  html += row("R<sub>s</sub>", given(m.machine.R_ohm, "ohm"), "phase", m.from.R);
  html += row("L<sub>s</sub> = L − M", given(m.machine.L_H, "H"), "phase", m.from.L);
  html +=
      row("K<sub>e</sub>", given(m.K_e_V_s, m.kind == sixstep::design::MotorKind::linear ? "V s/m" : "V s"),
          m.shape_is_table ? "phase, times the table" : "phase, peak", m.from.K_e);
  const bool linear = m.kind == sixstep::design::MotorKind::linear;
  html += row(linear ? "K<sub>f</sub>" : "K<sub>t</sub>", given(m.K_t_Nm_A, linear ? "N/A" : "Nm/A"),
              "terminal", m.from.K_t);
  html += linear ? row("Pole pitch τ", given(sixstep::base::pi / m.machine.pole_pairs, "m"), "", "")
                 : row("Pole pairs p", plain(m.machine.pole_pairs, 4, true), "", "");
  html += row("Back-EMF shape", shape_words(m), "electrical", "");
  html += row(linear ? "m" : "J", given(m.shaft.J_kg_m2, linear ? "kg" : "kg m2"), "mechanical",
              m.from.J.empty() ? "rotor, without the load" : m.from.J + ", without the load");
  const char *viscous = linear ? "N s/m" : "Nm s", *dry = linear ? "N" : "Nm";
  html += row("B", given(m.shaft.B_Nm_s, viscous), "mechanical", m.from.friction);
  if (m.shaft.coulomb_Nm != 0.0)
    html += row("T<sub>c0</sub>", given(m.shaft.coulomb_Nm, dry), "mechanical", "");
  if (m.iron.B_Nm_s != 0.0)
    html += row("B of the iron", given(m.iron.B_Nm_s, viscous), "mechanical", "iron_viscous_Nm_s, part of B");
  if (m.iron.coulomb_Nm != 0.0)
    html += row("T<sub>c0</sub> of the iron", given(m.iron.coulomb_Nm, dry), "mechanical",
                "iron_coulomb_mNm, part of T_c0");
  if (m.shaft.static_Nm != 0.0)
    html += row("T<sub>static</sub>", given(m.shaft.static_Nm, dry), "mechanical", "");
  if (!m.left_to_a_run.empty())
    html += row("Additional effects", m.left_to_a_run, "", "motor file; used in the run");
  return html + "</tbody></table>\n";
}

}  // namespace report
