// SPDX-License-Identifier: Apache-2.0
#include "report/energy_balance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "report/figures.hpp"
#include "report/html.hpp"
#include "report/sankey.hpp"
#include "sixstep/base/written.hpp"

namespace report {
namespace {

struct Entry {
  std::string name;
  std::string law;
  double joule;
};

/// A value that rounds to zero is printed without a sign.
std::string fixed(double value, int decimals) {
  const std::string text = fmt::format("{:.{}f}", std::abs(value), decimals);
  const bool zero = text.find_first_not_of("0.") == text.npos;
  return (value < 0.0 && !zero ? "−" : "") + text;
}

std::string bar(double joule, double largest) {
  if (joule == 0.0 || largest == 0.0) return "";
  return fmt::format("<i class=\"{}\" style=\"width:{:.1f}%\"></i>", joule < 0.0 ? "negative" : "",
                     100.0 * std::abs(joule) / largest);
}

/// Scales that the electrical and the mechanical account share.
struct Yardsticks {
  double largest;     ///< largest entry of both accounts
  double scale;       ///< the residuals are relative to this energy
  const char* parts;  ///< name of the energy `scale`
};

/// The value; or zero if its magnitude is below 1e-20 of the largest entry, which is less than any rounding
/// error.
double unless_nothing(double joule, double largest) {
  return std::abs(joule) < 1e-20 * largest ? 0.0 : joule;
}

std::string closing(double residual, const Yardsticks& y) {
  const bool nothing = unless_nothing(residual * y.scale, y.largest) == 0.0;
  return fmt::format("</tbody></table><p class=\"closing\">closes to <b>{}</b> of the energy {}</p>\n",
                     plain(nothing ? 0.0 : std::abs(residual), 2, true), y.parts);
}

/// One equation as an account: the entries must add up to the total; the residual is the difference.
std::string account(const Entry& total, const std::vector<Entry>& entries, double residual,
                    const Yardsticks& y) {
  const double largest = y.largest;
  const Scale scale = scale_for(largest, "J");
  constexpr int decimals = 4;  // the same in both accounts, so that the printed numbers add up
  const auto row = [&](const Entry& e, const char* css) {
    const double joule = e.joule * scale.factor;
    return fmt::format(
        "<tr class=\"{}\"><th scope=\"row\">{}<small>{}</small></th><td class=\"num\">{}</td>"
        "<td class=\"share\">{}</td></tr>\n",
        css, e.name, e.law, fixed(joule, decimals), bar(e.joule, largest));
  };
  std::string html = fmt::format(
      "<table class=\"ledger\"><thead><tr><th></th><th class=\"num\">{}</th><th></th></tr></thead><tbody>\n",
      scale.unit);
  html += row(total, "total");
  for (const Entry& e : entries) html += row(e, "part");
  const double missing = residual * y.scale;  // equal to the difference in the energy book to the last bit
  html += fmt::format(
      "<tr class=\"residual\"><th scope=\"row\">Residual<small>difference of the two sides</small></th><td "
      "class=\"num\">{}</td><td class=\"share\"></td></tr>\n",
      computed(unless_nothing(missing, largest), "J"));
  return html + closing(residual, y);
}

/// Symbols of the accounts, and their replacements for a linear motor.
constexpr sixstep::base::LinearWord linear_symbols[] = {{"T<sub>e</sub> ω", "F<sub>e</sub> v"},
                                                        {"T<sub>load</sub> ω", "F<sub>load</sub> v"},
                                                        {"½ J ω²", "½ m v²"}};

std::string told_in(const sixstep::base::Motion& motion, std::string html) {
  if (!motion.linear) return html;
  for (const sixstep::base::LinearWord& symbol : linear_symbols)
    sixstep::base::linear_text::replace(html, symbol, false);
  return sixstep::base::linear_words(html);
}

}  // namespace

std::string energy_section(const sixstep::study::EnergyBook& b, const sixstep::base::Motion& motion,
                           BookOf drive) {
  // Both accounts share the unit and the length of bars, because each contains the air-gap energy.
  double largest = 0.0;
  for (const double joule :
       {b.supplied, b.copper, b.devices, b.magnetic, b.air_gap, b.friction, b.load, b.kinetic})
    largest = std::max(largest, std::abs(joule));
  const Yardsticks yardsticks{largest, b.scale, b.scale > b.moved ? "stored" : "moved"};
  std::string html = energy_sankey(b) + "<div class=\"columns\"><div><h3>Electrical</h3>";
  html += account(
      {"Supplied by the bus", "∫ U<sub>s</sub> i dt", b.supplied},
      {{"Copper", drive.delta ? "∫ R<sub>x</sub> Σj² dt" : "∫ R<sub>s</sub> Σi² dt", b.copper},
       {"Switches and diodes", "conduction", b.devices},
       {"Magnetic field", drive.delta ? "Δ ½ L<sub>x</sub> Σj²" : "Δ ½ L<sub>s</sub> Σi²", b.magnetic},
       {"Across the air gap", "∫ T<sub>e</sub> ω dt", b.air_gap}},
      b.electrical_residual, yardsticks);
  html += "</div><div><h3>Mechanical</h3>";
  std::vector<Entry> shaft{
      {b.iron != 0.0 ? "Bearing friction" : "Friction", "viscous, Coulomb, in a gear", b.friction - b.iron}};
  if (b.iron != 0.0) shaft.push_back({"Iron drag", "eddy currents and hysteresis", b.iron});
  shaft.push_back({"Load", "∫ T<sub>load</sub> ω dt", b.load});
  const std::string stored = std::string(drive.twist ? ", twist" : "") + (drive.cogging ? ", cogging" : "");
  shaft.push_back({"Kinetic energy" + stored,
                   std::string(drive.twist ? "Δ ½ J ω² of both masses, Δ ½ k φ²" : "Δ ½ J ω²") +
                       (drive.cogging ? ", −∫ T<sub>cog</sub> ω dt" : ""),
                   b.kinetic});
  html += account({"Across the air gap", "∫ T<sub>e</sub> ω dt", b.air_gap}, shaft, b.mechanical_residual,
                  yardsticks);
  html += "</div></div>\n";
  if (drive.delta)
    html +=
        "<p class=\"origin\">j, R<sub>x</sub> and L<sub>x</sub> are current, resistance and inductance of one "
        "branch of the delta.</p>\n";
  if (b.brake_resistor > 0.0)
    html += fmt::format(
        "<p class=\"closing\">the brake resistor took <b>{}</b> from the bus; this energy is not part of the balance above, which begins at the bridge</p>\n",
        computed(b.brake_resistor, "J"));
  return told_in(motion, std::move(html));
}

std::string device_section(const std::vector<sixstep::study::DeviceLoss>& devices) {
  if (devices.empty()) return "";
  const bool known = devices.front().junction_degC > 0.0;
  std::string html =
      "<table class=\"events\"><thead><tr><th>Switch</th><th class=\"num\">conducts</th><th class=\"num\">turns "
      "on</th><th class=\"num\">turns off</th><th class=\"num\">diode</th><th class=\"num\">recovers</th>";
  html += known ? "<th class=\"num\">junction, mean</th></tr></thead><tbody>\n" : "</tr></thead><tbody>\n";
  for (const auto& d : devices) {
    html += fmt::format("<tr><th scope=\"row\">{}</th>", d.device);
    for (const double watt : {d.conduction_W, d.turn_on_W, d.turn_off_W, d.diode_W, d.recovery_W})
      html += fmt::format("<td class=\"num\">{}</td>", watt > 0.0 ? computed(watt, "W") : "");
    html += known ? fmt::format("<td class=\"num\">{} °C</td></tr>\n", fixed(d.junction_degC, 1)) : "</tr>\n";
  }
  return html + "</tbody></table><p class=\"closing\">mean powers over the run" +
         std::string(known ? ", and the junction's temperature at that mean power" : "") +
         "; efficiency and temperatures include the switching losses, the balance above does not</p>\n";
}

std::string event_section(const sixstep::study::Outcome& outcome) {
  std::string html =
      "<table class=\"events\"><thead><tr><th>Event</th><th class=\"num\">Count</th></tr></thead><tbody>\n";
  for (const auto& e : outcome.events)
    html += fmt::format("<tr><th scope=\"row\">{}</th><td class=\"num\">{}</td></tr>\n", escaped(e.event),
                        grouped(e.count));
  html += fmt::format(
      "<tr class=\"total\"><th scope=\"row\">segments solved</th><td class=\"num\">{}</td></tr>\n",
      grouped(outcome.segments));
  html += fmt::format(
      "<tr><th scope=\"row\">digest of the trajectory<small>the same on every platform</small></th>"
      "<td class=\"num\"><code>{}</code></td></tr>\n",
      sixstep::base::written_hex(outcome.digest));
  // Edge-aligned pulses begin at a tick, so half of their edges count as ticks; the note explains this.
  return html +
         "</tbody></table>\n<p class=\"origin\">A PWM edge at the instant of a control tick counts as a control tick. With "
         "complementary chopping an edge switches two gates of a leg, so that all six switches together may have "
         "more turn-ons.</p>\n";
}

}  // namespace report
