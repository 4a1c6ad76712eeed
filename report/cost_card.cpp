// SPDX-License-Identifier: Apache-2.0
#include "report/cost_card.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "report/figures.hpp"
#include "report/html.hpp"
#include "report/windows.hpp"

namespace report {
namespace {

using sixstep::study::EnergyBook;
using sixstep::study::Outcome;
using sixstep::study::Trace;

std::string entry(const std::string& name, double joule, const std::string& beside) {
  return fmt::format("<tr><th scope=\"row\">{}</th><td class=\"num\">{}</td><td class=\"num\">{}</td></tr>\n",
                     name, computed(joule, "J"), beside);
}

/// The rows with the parts of the supplied energy. A part may be negative if the motor returned energy.
std::string energy_rows_of(const EnergyBook& b) {
  const auto row = [&](const char* name, double joule) {
    // If energy flowed in and out again, the part is only a rounding error and is not shown.
    if (std::abs(joule) <= 1e-12 * b.moved) return std::string();
    return entry(name, joule, b.supplied > 0.0 ? in_percent(joule / b.supplied) : "");
  };
  return row("<b>Supplied</b>", b.supplied) + row("Copper", b.copper) + row("Switches, diodes", b.devices) +
         row(b.iron != 0.0 ? "Bearing friction" : "Friction", b.friction - b.iron) +
         row("Iron drag", b.iron) + row("Load", b.load) + row("Stored", b.kinetic + b.magnetic);
}

/// Switching energy from the run's mean powers.
double switching_J(const Outcome& outcome) {
  double watt = 0.0;
  for (const sixstep::study::DeviceLoss& d : outcome.devices)
    watt += d.turn_on_W + d.turn_off_W + d.recovery_W;
  return watt * outcome.simulated_s;
}

std::string switching_row(const Outcome& outcome) {
  const double joule = switching_J(outcome);
  return joule > 0.0 ? entry("Switching<br><small>not included</small>", joule, "") : "";
}

}  // namespace

double switching_frequency_Hz(const Outcome& outcome) {
  if (outcome.turn_ons <= outcome.chopped_switches) return 0.0;
  return static_cast<double>(outcome.turn_ons) / outcome.chopped_switches / outcome.simulated_s;
}

std::optional<std::array<long long, 6>> turn_on_counts(const Trace& trace) {
  static constexpr const char* names[] = {"gate_T1", "gate_T2", "gate_T3", "gate_T4", "gate_T5", "gate_T6"};
  std::array<long long, 6> counts{};
  const auto* time = find_column(trace, "t_s");
  if (!time) return std::nullopt;
  const auto first =
      static_cast<std::size_t>(std::ranges::lower_bound(*time, whole_from_s(trace)) - time->begin());
  const bool from_the_start = first == 0 && time->front() <= 0.0;
  bool any = false;
  for (std::size_t k = 0; k < 6; ++k) {
    const auto* gate = find_column(trace, names[k]);
    if (!gate) continue;
    any = true;
    counts[k] = from_the_start && gate->front() > 0.5;
    for (std::size_t n = first + 1; n < gate->size(); ++n)
      counts[k] += (*gate)[n] > 0.5 && (*gate)[n - 1] < 0.5;
  }
  return any ? std::optional(counts) : std::nullopt;
}

std::string switching_words(const Outcome& outcome, const Trace& trace) {
  const double seen_s = trace.whole.empty() ? outcome.simulated_s : outcome.simulated_s - whole_from_s(trace);
  const auto counts = turn_on_counts(trace);
  if (!counts || !(seen_s > 0.0)) return "";
  const double chopped_Hz = switching_frequency_Hz(outcome);
  const long long all = std::accumulate(counts->begin(), counts->end(), 0LL);
  if (chopped_Hz == 0.0 && all == 0 && trace.whole.empty()) return "none: no switch was turned on";
  std::string text = chopped_Hz > 0.0
                         ? fmt::format("chopped at <b>{}</b> on average", computed(chopped_Hz, "Hz"))
                         : std::string("no chopping");
  const std::string where = trace.whole.empty() ? "" : " in the last " + computed(seen_s, "s");
  if (all == 0) return text + "; no turn-on" + where;
  text += fmt::format("; {} {} of all six{}", grouped(all), all == 1 ? "turn-on" : "turn-ons", where);
  const auto busiest = std::ranges::max_element(*counts);
  if (*busiest > 1)
    text += fmt::format(", T{} most often, {} times", busiest - counts->begin() + 1, grouped(*busiest));
  return text;
}

std::string cost_content(const Outcome& outcome, const Trace& trace) {
  const std::string rows = (outcome.energy ? energy_rows_of(*outcome.energy) : "") + switching_row(outcome);
  const std::string switching = switching_words(outcome, trace);
  return (rows.empty() ? "" : "<table class=\"plain\"><tbody>" + rows + "</tbody></table>\n") +
         (switching.empty()
              ? ""
              : fmt::format("<dl><div><dt>Switching</dt><dd>{}</dd></div>\n</dl>\n", switching));
}

}  // namespace report
