// SPDX-License-Identifier: Apache-2.0
#include "report/spectra.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figures.hpp"
#include "report/html.hpp"
#include "report/windows.hpp"
#include "sixstep/study/measure/trace.hpp"

namespace report {
namespace {

/// A note on a stretch of fewer than two electrical turns. Its end value differs from its start value, and
/// this jump causes the strongest lines.
std::string cut_short(const Stretch& stretch) {
  constexpr double least_turn = 0.01;  // a held rotor that trembles has no electrical frequency
  if (!(stretch.part > least_turn)) return "";
  return fmt::format(
      "<p class=\"alert\">This part of the run has only {} electrical turns, fewer than two. The spectrum does not resolve lines of the electrical frequency and its multiples, and a strong line below the PWM frequency may be an effect of the start and end of this part. A longer run shows more turns.</p>\n",
      escaped(plain(stretch.part, 2)));
}

std::string how(const Spectra& s) {
  const Lines& lines = s.all.front().lines;
  const std::string part = s.stretch.turns > 0 ? fmt::format("{} electrical turns", grouped(s.stretch.turns))
                                               : std::string("part of the run with a constant setpoint");
  return fmt::format(
      "<p class=\"origin\">Amplitudes over the last {}, from {} to {}, with a Hann window and one line every {}. The frequency of a tone between two lines follows from both lines; a tone with a known cause is listed at the frequency of this cause. The curve is first averaged over {}; its mean is not shown.</p>\n",
      part, escaped(given(s.stretch.time.from, "s")), escaped(given(s.stretch.time.to, "s")),
      escaped(computed(lines.spacing_Hz, "Hz")), escaped(computed(lines.cell_s, "s")));
}

std::string table(const Spectra& s, const DrawnSpectrum& d) {
  if (d.lines.tones.empty())
    return fmt::format("<div><h3>{}</h3><p class=\"quiet\">No line exceeds the noise.</p></div>\n", d.title);
  constexpr std::size_t most = 6;
  const double seconds = s.stretch.time.to - s.stretch.time.from;
  const Causes causes{.turns = s.stretch.turns,
                      .periods = s.period_s > 0.0 ? seconds / s.period_s : 0.0,
                      .heat_steps = s.heat_step_s > 0.0 ? seconds / s.heat_step_s : 0.0,
                      .mains = seconds * s.mains_Hz,
                      .switchings = seconds * s.switching_Hz};
  std::string rows;
  for (std::size_t n = 0; n < std::min(most, d.lines.tones.size()); ++n) {
    const Tone& tone = d.lines.tones[n];
    const Origin origin = origin_of(tone.line, causes);
    rows += fmt::format("<tr><td class=\"num\">{}</td><td class=\"num\">{}</td><td>{}</td></tr>\n",
                        escaped(computed(origin.line * d.lines.spacing_Hz, "Hz")),
                        escaped(computed(tone.amplitude, d.unit)), escaped(origin.name));
  }
  return fmt::format(
      "<div><h3>{}, strongest lines</h3><table><thead><tr><th class=\"num\">Frequency</th><th "
      "class=\"num\">Amplitude</th>"
      "<th>Cause</th></tr></thead><tbody>\n{}</tbody></table></div>\n",
      d.title, rows);
}

/// Mean frequency of the turn-ons in the stretch. The column duty is then the state of the switch that the
/// comparators chop. 0 if there are fewer than two turn-ons.
double comparators_Hz(const sixstep::study::Trace& trace, const Interval& stretch) {
  const auto *time = find_column(trace, "t_s"), *duty = find_column(trace, "duty");
  if (!time || !duty) return 0.0;
  double first_s = 0.0, last_s = 0.0, turn_ons = 0.0;
  for (std::size_t n = 1; n < time->size(); ++n) {
    if (!((*duty)[n - 1] == 0.0 && (*duty)[n] != 0.0) || !stretch.holds((*time)[n])) continue;
    if (turn_ons == 0.0) first_s = (*time)[n];
    last_s = (*time)[n];
    ++turn_ons;
  }
  return last_s > first_s ? (turn_ons - 1) / (last_s - first_s) : 0.0;
}

}  // namespace

std::optional<Spectra> spectra(const sixstep::study::Trace& trace, const sixstep::study::Scenario& scenario,
                               double pole_pairs) {
  struct Wanted {
    const char *id, *title, *quantity, *unit, *label, *style, *column;
  };
  static constexpr Wanted turning{"torque-spectrum", "Spectrum of the torque", "torque", "Nm", "T_e", "main",
                                  "torque_Nm"},
      moving{"torque-spectrum", "Spectrum of the force", "", "N", "F", "main", "torque_Nm"};
  const bool linear = scenario.sheet.kind == sixstep::design::MotorKind::linear;
  const Wanted wanted[] = {
      {"current-spectrum", "Spectrum of the phase current", "current", "A", "i_a", "a", "i_a_A"},
      linear ? moving : turning};
  const auto stretch = steady_stretch(trace, scenario, pole_pairs);
  if (!stretch) return std::nullopt;
  const bool free_running = scenario.control.current.type == sixstep::study::CurrentLoopType::hysteresis &&
                            scenario.control.mode >= sixstep::control::Mode::current;
  using sixstep::study::SourceKind;
  const bool mains =
      scenario.supply.source == SourceKind::single_phase || scenario.supply.source == SourceKind::three_phase;
  Spectra out{*stretch,
              free_running ? 0.0 : scenario.pwm.period_s,
              free_running ? comparators_Hz(trace, stretch->time) : 0.0,
              scenario.heat.motor || scenario.heat.devices ? scenario.heat.step_s : 0.0,
              mains ? scenario.supply.mains_Hz : 0.0,
              {}};
  const auto& time = *find_column(trace, "t_s");
  for (const Wanted& w : wanted) {
    const auto* values = find_column(trace, w.column);
    if (!values) continue;
    // 64 cells per period: the drawn lines reach an eighth of the cells' frequency, which is eight times the
    // PWM's frequency. Only frequencies above 56 times the PWM's frequency could alias into the drawn lines.
    // Averaging over the cells reduces them to an eighth.
    Lines lines = lines_of(time, *values, stretch->time, scenario.pwm.period_s / 64);
    if (std::ranges::max(lines.amplitude) >= least_tone)
      out.all.push_back({w.id, w.title, w.quantity, w.unit, w.label, w.style, std::move(lines)});
  }
  if (out.all.empty()) return std::nullopt;
  return out;
}

std::string spectra_section(const std::optional<Spectra>& found) {
  if (!found) return "";
  std::string html = "<h2>Spectrum</h2>\n" + cut_short(found->stretch) + how(*found) +
                     "<div id=\"spectra\" class=\"columns wide\"></div>\n";
  html += "<div class=\"columns wide\">\n";
  for (const DrawnSpectrum& d : found->all) html += table(*found, d);
  return html + "</div>\n";
}

Drawn drawn_lines(const Lines& lines) {
  constexpr double steps = 1500.0;
  const double last = std::log(static_cast<double>(lines.amplitude.size() - 1));
  Drawn out;
  std::size_t highest = 0;
  long step = -1;
  for (std::size_t k = 1; k < lines.amplitude.size(); ++k) {
    const long here = std::lround(std::log(static_cast<double>(k)) / last * steps);
    if (here == step && lines.amplitude[k] <= lines.amplitude[highest]) continue;
    if (here != step) {
      out.frequency_Hz.push_back(0.0);
      out.amplitude.push_back(0.0);
    }
    step = here;
    highest = k;
    out.frequency_Hz.back() = static_cast<double>(k) * lines.spacing_Hz;
    out.amplitude.back() = lines.amplitude[k];
  }
  return out;
}

}  // namespace report
