// SPDX-License-Identifier: Apache-2.0
#include "report/curve_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <report_assets.hpp>

#include "report/curve_charts.hpp"
#include "report/figures.hpp"
#include "report/html.hpp"
#include "report/parameters.hpp"
#include "report/shell.hpp"
#include "sixstep/base/angle.hpp"
#include "sixstep/study/scenario/choices.hpp"

namespace report {
namespace {

namespace analysis = sixstep::analysis;
namespace study = sixstep::study;

constexpr double rpm_per_rad_s = 30 / sixstep::base::pi, milli = 1e3;

std::string rpm(double rad_s) { return plain(rad_s * rpm_per_rad_s, 5) + "\u00a0rpm"; }
std::string mNm(double Nm) { return plain(Nm * milli, 4) + "\u00a0mNm"; }
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

std::string certainty(const analysis::Curve& curve) {
  double bound = 0.0, residual = 0.0, width = 0.0;
  for (const analysis::OperatingPoint& p : curve.points) {
    bound = std::max(bound, p.error_bound_A);
    width = std::max(width, p.half_width_Nm);
    residual = std::max(residual, p.energy_residual < 0 ? -p.energy_residual : p.energy_residual);
  }
  return fmt::format("{}, energy balance to {}",
                     width > 0 ? fmt::format("mean torque ± {} at 99\u00a0%", mNm(width))
                               : fmt::format("steady currents within {}", computed(bound, "A")),
                     plain(residual, 2));
}

std::string nominal_fact(const analysis::CurveRequest& r, const analysis::NominalPoint& n) {
  std::string text;
  const auto item = [&](const std::string& what) { text += (text.empty() ? "" : ", ") + what; };
  if (n.torque_Nm) item(mNm(*n.torque_Nm));
  if (n.speed_rad_s) item(rpm(*n.speed_rad_s));
  if (n.current_A) item(amperes(*n.current_A));
  if (r.bench.duty != 1 || r.bench.voltage_V != r.bench.motor.nominal_voltage_V || !n.at_torque) return text;
  text += "; at that torque the curve has " + rpm(n.at_torque->speed_rad_s);
  if (n.speed_rad_s) text += fmt::format(" ({})", deviation(n.at_torque->speed_rad_s, *n.speed_rad_s, ""));
  return text + ", " + amperes(n.at_torque->winding_current_A);
}

/// Why a sheet's gradient is not the curve's.
std::string drop_fact(const analysis::SpeedDrop& d) {
  const auto per_mNm = [](double x) { return plain(x * rpm_per_rad_s / milli, 3); };
  std::string text = "curve " + per_mNm(*d.curve);
  if (d.sheet) text += ", the sheet's two points " + per_mNm(*d.sheet);
  text += fmt::format("; R/Kₜ² = {}", per_mNm(d.ideal));
  if (d.printed) text += fmt::format(", printed {},", per_mNm(*d.printed));
  return text + " leaves out the time that commutation takes";
}

std::string locked_fact(const analysis::OperatingPoint& turning) {
  const analysis::LockedRotor& l = *turning.locked;
  const bool one = l.greatest_torque_Nm - l.least_torque_Nm <= 1e-9 * l.greatest_torque_Nm;
  return fmt::format("{} through two phases, {}{}", amperes(l.phase_rms_A), mNm(l.least_torque_Nm),
                     one ? "" : " … " + mNm(l.greatest_torque_Nm) + " with the angle");
}

std::string lasting_fact(const analysis::Curve& curve) {
  if (!curve.marks.for_ever) return "not even without load";
  const analysis::OperatingPoint& from = *curve.marks.for_ever;
  return fmt::format("from {} ({}) on", rpm(from.speed_rad_s), mNm(from.shaft_torque_Nm));
}

std::string facts(const analysis::CurveRequest& r, const analysis::Curve& curve) {
  const analysis::NoLoad& n = curve.no_load;
  std::string html =
      fact("Locked rotor", locked_fact(curve.points.front())) +
      fact("No load", fmt::format("{}, {}", rpm(n.point.speed_rad_s), amperes(n.point.winding_current_A))) +
      fact("A rotor let free runs at", rpm(n.free_speed_rad_s)) +
      fact("Ideal line", fmt::format("{} … {}", mNm(analysis::ideal_torque_Nm(r.bench, 0.0)),
                                     rpm(analysis::ideal_no_load_rad_s(r.bench))));
  if (const auto& best = curve.marks.best_efficiency)
    html += fact("Best efficiency", fmt::format("{}\u00a0% at {}, {}", plain(100 * *best->efficiency, 3),
                                                rpm(best->speed_rad_s), mNm(best->shaft_torque_Nm)));
  if (curve.nominal) html += fact("Nominal point of the sheet", nominal_fact(r, *curve.nominal));
  if (curve.nominal && curve.nominal->at_torque)
    html += fact("Speed lost per torque, rpm/mNm", drop_fact(analysis::speed_drop(r, curve)));
  if (curve.thermal) {
    const analysis::ThermalLimits still = analysis::thermal_limits(*curve.thermal, r, 0.0);
    html += fact(fmt::format("Current at {}\u00a0°C ambient", plain(r.ambient_degC, 3, true)),
                 fmt::format("{} for ever, {} for 60\u00a0s, {} for 10\u00a0s", amperes(still.continuous_A),
                             amperes(still.short_A[1]), amperes(still.short_A[0]))) +
            fact("The curve itself can be held for ever", lasting_fact(curve));
  }
  return html + fact("Certainty", certainty(curve));
}

std::string cell(double x, int digits = 4) {
  const bool nothing = std::fabs(x) < 1e-9;  // a no-load point's rounding
  return fmt::format("<td class=\"num\">{}</td>", nothing ? "0" : plain(x, digits));
}

std::string row(const analysis::CurveRequest& r, const analysis::OperatingPoint& p) {
  std::string html = "<tr>" + cell(p.speed_rad_s * rpm_per_rad_s, 5) + cell(p.shaft_torque_Nm * milli) +
                     cell(analysis::ideal_torque_Nm(r.bench, p.speed_rad_s) * milli) +
                     cell(p.ripple_Nm * milli, 3);
  for (const double x : {p.winding_current_A, p.phase_rms_A, p.phase_peak_A, p.bus_current_A, p.supplied_W,
                         p.copper_W, p.devices_W, p.friction_W, p.shaft_W})
    html += cell(x);
  html += p.efficiency ? cell(100 * *p.efficiency, 3) : "<td class=\"num\">–</td>";
  return html + "</tr>\n";
}

std::string table(const analysis::CurveRequest& r, const analysis::Curve& curve) {
  std::string html = "<table><thead><tr>";
  for (const char* name : {"Speed<br>rpm", "Torque<br>mNm", "Ideal<br>mNm", "Ripple<br>mNm pp",
                           "Winding<br>A", "Phase rms<br>A", "Peak<br>A", "Supply<br>A", "In<br>W",
                           "Copper<br>W", "Devices<br>W", "Friction<br>W", "Out<br>W", "Efficiency<br>%"})
    html += fmt::format("<th class=\"num\">{}</th>", name);
  html += "</tr></thead><tbody>\n";
  for (const analysis::OperatingPoint& p : curve.points) html += row(r, p);
  return html + "</tbody></table>\n";
}

std::string alerts(const analysis::Curve& curve) {
  if (curve.thermal) return "";
  return fmt::format("<p class=\"notes\">No thermal limits: {}.</p>\n",
                     escaped(to_string(curve.thermal_missing[0])));
}

}  // namespace

std::string render_curve(const CurvePageInput& in) {
  const std::string title = escaped(in.request.sheet.name);
  const std::string body = filled(assets::curve_html, {{"title", title},
                                                       {"subtitle", escaped(subtitle(in.request))},
                                                       {"facts", facts(in.request, in.curve)},
                                                       {"notes", alerts(in.curve)},
                                                       {"table", table(in.request, in.curve)},
                                                       {"sheet", sheet_section(in.request.sheet)},
                                                       {"model", model_section(in.request.bench.motor)}});
  return in_shell(
      {.title = "Torque-speed curve · " + title, .body = body, .command = in.command, .version = in.version},
      curve_charts(in.request, in.curve),
      {assets::curves_js, assets::chart_js, assets::rows_js, assets::page_js, assets::curve_js});
}

}  // namespace report
