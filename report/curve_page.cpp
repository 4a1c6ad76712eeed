// SPDX-License-Identifier: Apache-2.0
#include "report/curve_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <report_assets.hpp>

#include "report/curve_charts.hpp"
#include "report/curve_units.hpp"
#include "report/figures.hpp"
#include "report/html.hpp"
#include "report/parameters.hpp"
#include "report/shell.hpp"
#include "sixstep/study/scenario/choices.hpp"

namespace report {
namespace {

namespace analysis = sixstep::analysis;
namespace base = sixstep::base;
namespace study = sixstep::study;

std::string amperes(double A) { return plain(A, 4) + "\u00a0A"; }

std::string fact(std::string_view name, const std::string& value) {
  return fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", name, escaped(value));
}

std::string subtitle(const analysis::CurveRequest& r) {
  const analysis::Bench& b = r.bench;
  std::string text = fmt::format("{}\u00a0V", plain(b.voltage_V, 5, true));
  if (b.duty == 1) return text + ", full duty";
  return text + fmt::format(", duty {}, {} chopping at {}", plain(b.duty, 4, true),
                            sixstep::base::word(study::chopping_choices, b.chopping),
                            given(1 / b.pwm_period_s, "Hz"));
}

std::string certainty(const analysis::Curve& curve, const CurveUnits& u) {
  double bound = 0.0, residual = 0.0, width = 0.0;
  for (const analysis::OperatingPoint& p : curve.points) {
    bound = std::max(bound, p.error_bound_A);
    width = std::max(width, p.half_width_Nm);
    residual = std::max(residual, p.energy_residual < 0 ? -p.energy_residual : p.energy_residual);
  }
  return fmt::format("{}, energy balance to {}",
                     width > 0 ? fmt::format("mean torque ± {} at 99\u00a0%", u.torque_text(width))
                               : fmt::format("steady currents within {}", computed(bound, "A")),
                     plain(residual, 2));
}

std::string nominal_name(const analysis::NominalPoint& n) {
  return n.from.empty() ? "Nominal point of the sheet" : "Nominal point, " + escaped(n.from);
}

std::string nominal_fact(const analysis::CurveRequest& r, const analysis::NominalPoint& n,
                         const CurveUnits& u) {
  std::string text;
  const auto item = [&](const std::string& what) { text += (text.empty() ? "" : ", ") + what; };
  if (n.torque_Nm) item(u.torque_text(*n.torque_Nm));
  if (n.speed_rad_s) item(u.speed_text(*n.speed_rad_s));
  if (n.current_A) item(amperes(*n.current_A));
  if (r.bench.duty != 1 || r.bench.voltage_V != r.bench.motor.nominal_voltage_V || !n.at_torque) return text;
  text += "; at this torque the curve has " + u.speed_text(n.at_torque->speed_rad_s);
  if (n.speed_rad_s) text += fmt::format(" ({})", deviation(n.at_torque->speed_rad_s, *n.speed_rad_s, ""));
  return text + ", " + amperes(n.at_torque->winding_current_A);
}

/// Explains why the sheet's speed-torque gradient differs from the curve's.
std::string drop_fact(const analysis::SpeedDrop& d, const CurveUnits& u) {
  const auto per_torque = [&](double x) { return plain(x * u.per_rad_s / u.per_Nm, 3); };
  std::string text = "curve " + per_torque(*d.curve);
  if (d.sheet) text += ", between the sheet's no-load and nominal points " + per_torque(*d.sheet);
  text += fmt::format("; R/Kₜ² = {}", per_torque(d.ideal));
  if (d.printed) text += fmt::format(", printed {},", per_torque(*d.printed));
  return text + " neglects the commutation time";
}

std::string locked_fact(const analysis::OperatingPoint& turning, const CurveUnits& u) {
  const analysis::LockedRotor& l = *turning.locked;
  const bool one = l.greatest_torque_Nm - l.least_torque_Nm <= 1e-9 * l.greatest_torque_Nm;
  return fmt::format("{} through two phases, {}{}", amperes(l.phase_rms_A), u.torque_text(l.least_torque_Nm),
                     one ? "" : " … " + u.torque_text(l.greatest_torque_Nm) + " with the angle");
}

std::string lasting_fact(const analysis::Curve& curve, const CurveUnits& u) {
  if (!curve.marks.for_ever) return "nowhere: the winding becomes too hot even without load";
  const analysis::OperatingPoint& from = *curve.marks.for_ever;
  return fmt::format("from {} ({}) on", u.speed_text(from.speed_rad_s), u.torque_text(from.shaft_torque_Nm));
}

std::string stands_fact(const analysis::ThermalLimits& still) {
  if (std::isnan(still.continuous_A)) return "none";
  return fmt::format("{} continuously, {} for 60\u00a0s, {} for 10\u00a0s", amperes(still.continuous_A),
                     amperes(still.short_A[1]), amperes(still.short_A[0]));
}

std::string thermal_facts(const analysis::CurveRequest& r, const analysis::Curve& curve,
                          const CurveUnits& u) {
  if (!curve.thermal) return "";
  std::string html = fact(fmt::format("Current at {}\u00a0°C ambient", plain(r.ambient_degC, 3, true)),
                          stands_fact(analysis::thermal_limits(*curve.thermal, r, 0.0)));
  html += fact("Part of the curve that the winding withstands continuously", lasting_fact(curve, u));
  if (!curve.by_values) return html;
  return html +
         fact("All limits are computed with the worse ends of the motor file's ranges", curve.worse_ends) +
         fact("Current with the motor file's values themselves",
              stands_fact(analysis::thermal_limits(*curve.by_values, r, 0.0)));
}

std::string facts(const analysis::CurveRequest& r, const analysis::Curve& curve, const CurveUnits& u) {
  const analysis::NoLoad& n = curve.no_load;
  std::string html =
      fact("Locked rotor", locked_fact(curve.points.front(), u)) +
      fact("No load",
           fmt::format("{}, {}", u.speed_text(n.point.speed_rad_s), amperes(n.point.winding_current_A))) +
      fact("A free rotor reaches", u.speed_text(n.free_speed_rad_s)) +
      fact("Ideal line", fmt::format("{} … {}", u.torque_text(analysis::ideal_torque_Nm(r.bench, 0.0)),
                                     u.speed_text(analysis::ideal_no_load_rad_s(r.bench))));
  if (!r.bench.motor.left_to_a_run.empty())
    html += fact("Effects that a run simulates and this curve neglects", r.bench.motor.left_to_a_run);
  if (sixstep::design::on_R(r.motor_degC) != 1 || sixstep::design::on_K_e(r.sheet, r.motor_degC) != 1)
    html += fact("Winding and magnets at",
                 fmt::format("{} and {}\u00a0°C", plain(r.motor_degC.winding_degC, 3, true),
                             plain(r.motor_degC.housing_degC, 3, true)));
  if (const auto& best = curve.marks.best_efficiency)
    html += fact("Best efficiency",
                 fmt::format("{}\u00a0% at {}, {}", plain(100 * *best->efficiency, 3),
                             u.speed_text(best->speed_rad_s), u.torque_text(best->shaft_torque_Nm)));
  if (curve.nominal) html += fact(nominal_name(*curve.nominal), nominal_fact(r, *curve.nominal, u));
  if (curve.nominal && curve.nominal->at_torque)
    html += fact(fmt::format("Speed lost per torque, {}/{}", u.speed, u.torque),
                 drop_fact(analysis::speed_drop(r, curve), u));
  return u.motion.words(html + thermal_facts(r, curve, u) + fact("Certainty", certainty(curve, u)));
}

std::string cell(double x, int digits = 4) {
  const bool nothing = std::fabs(x) < 1e-9;  // a rounding error at a no-load point
  return fmt::format("<td class=\"num\">{}</td>", nothing ? "0" : plain(x, digits));
}

std::string row(const analysis::CurveRequest& r, const analysis::OperatingPoint& p, const CurveUnits& u) {
  std::string html = "<tr>" + cell(p.speed_rad_s * u.per_rad_s, 5) + cell(p.shaft_torque_Nm * u.per_Nm) +
                     cell(analysis::ideal_torque_Nm(r.bench, p.speed_rad_s) * u.per_Nm) +
                     cell(p.ripple_Nm * u.per_Nm, 3);
  for (const double x : {p.winding_current_A, p.phase_rms_A, p.phase_peak_A, p.bus_current_A, p.supplied_W,
                         p.copper_W, p.devices_W, p.friction_W, p.shaft_W})
    html += cell(x);
  html += p.efficiency ? cell(100 * *p.efficiency, 3) : "<td class=\"num\">–</td>";
  return html + "</tr>\n";
}

std::string table(const analysis::CurveRequest& r, const analysis::Curve& curve, const CurveUnits& u) {
  std::string html = "<table><thead><tr>";
  html += fmt::format("<th class=\"num\">Speed<br>{}</th><th class=\"num\">{}<br>{}</th>", u.speed,
                      u.motion.words("Torque"), u.torque);
  html += fmt::format("<th class=\"num\">Ideal<br>{0}</th><th class=\"num\">Ripple<br>{0} pp</th>", u.torque);
  for (const char* name : {"Winding<br>A", "Phase rms<br>A", "Peak<br>A", "Supply<br>A", "In<br>W",
                           "Copper<br>W", "Devices<br>W", "Friction<br>W", "Out<br>W", "Efficiency<br>%"})
    html += fmt::format("<th class=\"num\">{}</th>", name);
  html += "</tr></thead><tbody>\n";
  for (const analysis::OperatingPoint& p : curve.points) html += row(r, p, u);
  return html + "</tbody></table>\n";
}

std::string alerts(const analysis::CurveRequest& r, const analysis::Curve& curve,
                   const base::Motion& motion) {
  std::string notes;
  if (const std::string bound = analysis::without_friction(r); !bound.empty())
    notes = fmt::format("<p class=\"notes\">{}</p>\n", escaped(motion.words(bound)));
  if (curve.thermal) return notes;
  return notes + fmt::format("<p class=\"notes\">No thermal limits: {}.</p>\n",
                             escaped(motion.words(to_string(curve.thermal_missing[0]))));
}

}  // namespace

std::string render_curve(const CurvePageInput& in) {
  const std::string title = escaped(in.request.sheet.name);
  const CurveUnits u = curve_units(in.request);
  const std::string kind = u.motion.words("Torque-speed curve");
  const std::string body = filled(assets::curve_html(), {{"kind", kind},
                                                         {"title", title},
                                                         {"subtitle", escaped(subtitle(in.request))},
                                                         {"facts", facts(in.request, in.curve, u)},
                                                         {"notes", alerts(in.request, in.curve, u.motion)},
                                                         {"table", table(in.request, in.curve, u)},
                                                         {"sheet", sheet_section(in.request.sheet)},
                                                         {"model", model_section(in.request.bench.motor)}});
  return in_shell(
      {.title = kind + " · " + title, .body = body, .command = in.command, .version = in.version},
      curve_charts(in.request, in.curve),
      {assets::curves_js(), assets::chart_js(), assets::rows_js(), assets::page_js(), assets::curve_js()});
}

}  // namespace report
