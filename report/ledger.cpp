// SPDX-License-Identifier: Apache-2.0
#include "report/ledger.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figures.hpp"
#include "report/html.hpp"
#include "report/sankey.hpp"
#include "sixstep/base/written.hpp"

namespace report {
namespace {

struct Entry {
  const char* name;
  const char* law;
  double joule;
};

/// Rounded away, zero has no sign.
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

/// One equation as an account: the entries must add up to the total; what they miss is the residual.
std::string account(const Entry& total, std::initializer_list<Entry> entries, double residual,
                    double largest) {
  const Scale scale = scale_for(largest, "J");
  constexpr int decimals = 4;  // the same in both accounts, so that they add up under the reader's eye
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
  double missing = total.joule;
  for (const Entry& e : entries) {
    html += row(e, "part");
    missing -= e.joule;
  }
  html += fmt::format(
      "<tr class=\"residual\"><th scope=\"row\">Residual<small>what does not add up</small></th><td "
      "class=\"num\">{}</td><td class=\"share\"></td></tr>\n",
      computed(missing, "J"));
  html += fmt::format("</tbody></table><p class=\"closing\">closes to <b>{}</b> of the energy moved</p>\n",
                      plain(std::abs(residual), 2, true));
  return html;
}

}  // namespace

std::string energy_section(const sixstep::study::EnergyBook& b) {
  // One unit and one length of bar for both accounts: the air gap's energy stands in each.
  double largest = 0.0;
  for (const double joule :
       {b.supplied, b.copper, b.devices, b.magnetic, b.air_gap, b.friction, b.load, b.kinetic})
    largest = std::max(largest, std::abs(joule));
  std::string html = energy_sankey(b) + "<div class=\"columns\"><div><h3>Electrical</h3>";
  html += account({"Supplied by the bus", "∫ U<sub>s</sub> i dt", b.supplied},
                  {{"Copper", "∫ R<sub>s</sub> Σi² dt", b.copper},
                   {"Switches and diodes", "conduction", b.devices},
                   {"Magnetic field", "Δ ½ L<sub>s</sub> Σi²", b.magnetic},
                   {"Across the air gap", "∫ T<sub>e</sub> ω dt", b.air_gap}},
                  b.electrical_residual, largest);
  html += "</div><div><h3>Mechanical</h3>";
  html += account({"Across the air gap", "∫ T<sub>e</sub> ω dt", b.air_gap},
                  {{"Friction", "viscous and Coulomb", b.friction},
                   {"Load", "∫ T<sub>load</sub> ω dt", b.load},
                   {"Kinetic energy", "Δ ½ J ω²", b.kinetic}},
                  b.mechanical_residual, largest);
  return html + "</div></div>\n";
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
  return html + "</tbody></table>\n";
}

}  // namespace report
