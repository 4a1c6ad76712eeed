// SPDX-License-Identifier: Apache-2.0
#include "report/parameters.hpp"

#include <fmt/format.h>

#include "report/figures.hpp"
#include "report/html.hpp"

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

/// As printed: the sheet's own unit, no prefix juggling.
std::string row(std::string_view name, const Quantity& q, std::string_view unit,
                std::string_view frame = "") {
  return row(name, plain(q.value, 7, true) + "\u00a0" + std::string(unit), q.frame.empty() ? frame : q.frame,
             q.source);
}

std::string row(std::string_view name, const std::optional<Quantity>& q, std::string_view unit,
                std::string_view frame = "") {
  return q ? row(name, *q, unit, frame) : "";
}

}  // namespace

std::string sheet_section(const sixstep::design::Sheet& s) {
  std::string html = sheet_head;
  html += row("Nominal voltage U<sub>N</sub>", s.nominal_voltage_V, "V");
  html += row("Resistance R", s.resistance_ohm, "Ω");
  html += row("Inductance L", s.inductance_mH, "mH");
  html += row("Inductance L<sub>d</sub>", s.d_axis_inductance_mH, "mH");
  html += row("Inductance L<sub>q</sub>", s.q_axis_inductance_mH, "mH");
  html += row("Torque constant K<sub>t</sub>", s.torque_constant_mNm_A, "mNm/A", "terminal");
  html += row("Torque constant K<sub>t</sub>", s.torque_constant_Nm_A, "Nm/A");
  html += row("Back-EMF constant", s.back_emf_constant_V_krpm, "V/krpm");
  html += row("Flux linkage ψ<sub>f</sub>", s.flux_linkage_mWb, "mWb", "phase");
  html += row("Back-EMF constant", s.back_emf_mV_s, "mV s", "phase, mechanical");
  html += row("Rotor inertia J", s.inertia_gcm2, "g cm²");
  html += row("Inertia with brake", s.inertia_with_brake_gcm2, "g cm²");
  html += row("Viscous friction B", s.viscous_friction_Nm_s, "Nm s", "mechanical");
  html += row("Coulomb friction", s.coulomb_friction_mNm, "mNm");
  html += row("No-load speed", s.no_load_speed_rpm, "rpm", "mechanical");
  html += row("No-load current", s.no_load_current_mA, "mA", "terminal");
  html += row("Nominal speed", s.nominal_speed_rpm, "rpm", "mechanical");
  html += row("Nominal torque", s.nominal_torque_mNm, "mNm");
  html += row("Nominal current", s.nominal_current_A, "A", "terminal");
  html += row("Stall torque", s.stall_torque_mNm, "mNm");
  html += row("Stall current", s.stall_current_A, "A", "terminal");
  html += row("Speed constant", s.speed_constant_rpm_V, "rpm/V", "terminal");
  html += row("Largest speed", s.max_speed_rpm, "rpm", "mechanical");
  return html + "</tbody></table>\n";
}

std::string model_section(const sixstep::design::MotorModel& m) {
  const bool sine = m.machine.back_emf == sixstep::plant::BackEmf::sine;
  std::string html = model_head;
  html += row("R<sub>s</sub>", given(m.machine.R_ohm, "ohm"), "phase", m.from.R);
  html += row("L<sub>s</sub> = L − M", given(m.machine.L_H, "H"), "phase", m.from.L);
  html += row("K<sub>e</sub>", given(m.machine.K_e_V_s, "V s"), "phase, peak", m.from.K_e);
  html += row("K<sub>t</sub>", given(m.K_t_Nm_A, "Nm/A"), "terminal", m.from.K_t);
  html += row("Pole pairs p", std::to_string(m.machine.pole_pairs), "", "");
  html += row("Back-EMF shape",
              sine ? "sine" : fmt::format("trapezoid, {}° flat", plain(m.machine.flat_deg, 4, true)),
              "electrical", "");
  html += row("J", given(m.shaft.J_kg_m2, "kg m2"), "mechanical",
              m.from.J.empty() ? "rotor and load" : m.from.J + ", and load");
  html += row("B", given(m.shaft.B_Nm_s, "Nm s"), "mechanical", m.from.friction);
  if (m.shaft.coulomb_Nm != 0.0)
    html += row("T<sub>c0</sub>", given(m.shaft.coulomb_Nm, "Nm"), "mechanical", "");
  if (m.shaft.static_Nm != 0.0)
    html += row("T<sub>static</sub>", given(m.shaft.static_Nm, "Nm"), "mechanical", "");
  return html + "</tbody></table>\n";
}

}  // namespace report
