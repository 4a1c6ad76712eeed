// SPDX-License-Identifier: Apache-2.0
// Prints the gains in use, the exactly designed gains, every step of the design, and the parameters of a
// user's controller.
#include <fmt/format.h>

#include <cmath>

#include "report/figures.hpp"
#include "report/html.hpp"
#include "report/parameters.hpp"
#include "sixstep/base/linear.hpp"
#include "sixstep/study/scenario/own_numbers.hpp"

namespace report {
namespace {

using sixstep::study::LoopGains;

std::string gain_table(const LoopGains& g, bool linear) {
  const double mm_per_deg = sixstep::base::in_linear("deg").factor;
  if (g.loop == "position")
    return fmt::format(
        "<table class=\"gains\"><tbody><tr><th scope=\"row\">gain</th><td class=\"num strong\">{} {}"
        "</td></tr></tbody></table>\n",
        plain(linear ? g.d1 / mm_per_deg : g.d1, 6, true), linear ? "m/s per mm" : "rad/s per degree");
  if (!g.steps.empty())
    return fmt::format(
        "<table class=\"gains\"><tbody><tr><th scope=\"row\">K</th><td class=\"num strong\">{} {}</td></tr></tbody></table>\n",
        plain(g.d1, 6, true), gain_unit(g, linear));
  const auto row = [&](const char* symbol, double used, double exact) {
    std::string html =
        fmt::format("<tr><th scope=\"row\">{}</th><td class=\"num strong\">{}</td>", symbol, plain(used, 6));
    if (g.derivation)
      html += fmt::format(
          "<td class=\"num\">{}</td><td class=\"num\">{}</td>", plain(exact, 6),
          std::abs(used - exact) <= 1e-12 * std::abs(exact) ? "same" : deviation(used, exact, ""));
    return html + "</tr>\n";
  };
  const auto exact = g.derivation ? g.derivation->gains : sixstep::design::PiGains{};
  std::string html = fmt::format("<table class=\"gains\"><thead><tr><th></th><th class=\"num\">used, {}</th>",
                                 gain_unit(g, linear));
  if (g.derivation) html += "<th class=\"num\">pole placement</th><th class=\"num\">deviation</th>";
  html += "</tr></thead><tbody>\n";
  html += row("d<sub>1</sub> = K", g.d1, exact.d1);
  html += row("d<sub>0</sub>", g.d0, exact.d0);
  html += row("K<sub>i</sub> = d<sub>0</sub> + d<sub>1</sub>", g.d0 + g.d1, exact.d0 + exact.d1);
  return html + "</tbody></table>\n";
}

}  // namespace

std::string_view gain_unit(const LoopGains& g, bool linear) {
  if (g.loop.starts_with("current")) return "V/A";
  return linear ? "full output per m/s" : "full output per rad/s";
}

std::string derivation_table(const std::vector<sixstep::design::DerivationStep>& steps, bool linear) {
  std::string html =
      "<table class=\"steps\"><thead><tr><th>Step</th><th>Formula</th><th "
      "class=\"num\">Value</th></tr></thead><tbody>\n";
  for (const auto& step : steps) {
    // For a linear motor, the unit of a frequency is 1/s: rad/s could be mistaken for a speed.
    const Scale scale = scale_for(step.value, linear && step.unit == "rad/s" ? "1/s" : step.unit);
    html += fmt::format(
        "<tr><th scope=\"row\">{}</th><td class=\"formula\">{}</td><td class=\"num\">{}{}{}</td></tr>\n",
        typeset(step.symbol), typeset(step.formula), plain(step.value * scale.factor, 6, true),
        scale.unit.empty() ? "" : "\u00a0", escaped(scale.unit));
  }
  return html + "</tbody></table>\n";
}

std::string without_gains(const sixstep::study::Scenario& scenario) {
  using sixstep::control::Mode;
  const sixstep::study::Control& c = scenario.control;
  if (c.mode == Mode::off) return "off";
  if (c.mode == Mode::duty) return "none: the duty is given";
  if (c.drive == sixstep::study::FirmwareKind::field && c.field.law == sixstep::study::FieldLaw::finite_set)
    return "no gains: the controller chooses the state whose predicted current is nearest to the reference";
  if (c.drive != sixstep::study::FirmwareKind::own &&
      c.current.type == sixstep::study::CurrentLoopType::hysteresis)
    return "current by hysteresis, ±" + computed(c.current.band_A, "A") +
           ": a band instead of gains; the switching frequency follows from the motor";
  return "";
}

std::string gains_section(const sixstep::study::Scenario& scenario, const sixstep::study::Outcome& outcome) {
  const bool linear = outcome.motor.kind == sixstep::design::MotorKind::linear;
  const std::string without = without_gains(scenario);
  std::string html = without.empty() ? "" : "<p class=\"quiet\">Controller: " + escaped(without) + ".</p>\n";
  for (const LoopGains& g : outcome.gains) {
    html += fmt::format(
        "<div class=\"loop\"><h3>{} loop</h3><p class=\"origin\">{}</p>\n<div "
        "class=\"columns\"><div>{}</div>",
        escaped(g.loop), escaped(g.origin), gain_table(g, linear));
    if (g.derivation) html += "<div>" + derivation_table(g.derivation->steps, linear) + "</div>";
    if (!g.steps.empty()) html += "<div>" + derivation_table(g.steps, linear) + "</div>";
    html += "</div></div>\n";
  }
  if (!outcome.sensorless_steps.empty())
    html += "<div class=\"loop\"><h3>Sensorless drive</h3><p class=\"origin\">designed from the sheet</p>\n" +
            derivation_table(outcome.sensorless_steps, linear) + "</div>\n";
  if (!outcome.field_steps.empty())
    html +=
        "<div class=\"loop\"><h3>Field-oriented drive</h3><p class=\"origin\">designed from the sheet</p>\n" +
        derivation_table(outcome.field_steps, linear) + "</div>\n";
  if (!outcome.estimator_steps.empty())
    html +=
        "<div class=\"loop\"><h3>Angle of the magnet</h3><p class=\"origin\">designed from the sheet</p>\n" +
        derivation_table(outcome.estimator_steps, linear) + "</div>\n";
  return html;
}

std::string own_section(const sixstep::study::Own& own) {
  std::string rows;
  for (const sixstep::study::UsedNumber& number : sixstep::study::used_numbers(own))
    rows += fmt::format("<tr><th scope=\"row\">{}</th><td class=\"num\">{}</td><td>{}</td><td>{}</td></tr>\n",
                        escaped(number.is->name), escaped(given(number.value, number.is->unit)),
                        number.preset ? "preset" : "scenario", escaped(number.is->meaning));
  const std::string name = own.loaded ? escaped(own.loaded->name) : "";
  if (rows.empty())
    return "<p class=\"quiet\">A controller of your own, " + name + ": it has no numbers.</p>\n";
  return "<div class=\"loop\"><h3>" + name +
         "</h3><table class=\"own\"><thead><tr><th>Number</th><th "
         "class=\"num\">Value</th><th>From</th><th>Meaning</th></tr></thead><tbody>\n" +
         rows + "</tbody></table></div>\n";
}

}  // namespace report
