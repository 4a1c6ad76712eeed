// SPDX-License-Identifier: Apache-2.0
#include "report/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/cost_card.hpp"
#include "report/figures.hpp"
#include "report/highlights.hpp"
#include "report/html.hpp"
#include "report/parameters.hpp"
#include "report/svg_chart.hpp"
#include "report/verdicts.hpp"
#include "report/windows.hpp"
#include "sixstep/base/linear.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/scenario/own_numbers.hpp"

namespace report {
namespace {

using sixstep::study::LoopGains;
using sixstep::study::Outcome;
using sixstep::study::Scenario;
using sixstep::study::Trace;
using sixstep::study::Verdict;

std::string answer(std::string_view name, const std::string& text) {
  return fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", name, text);
}

std::string card(std::string_view css, std::string_view title, const std::string& content) {
  return fmt::format("<section class=\"card {}\"><h2>{}</h2>{}</section>\n", css, title, content);
}

std::string list(const std::string& answers) { return "<dl>" + answers + "</dl>\n"; }

std::string closest(const Outcome& outcome) {
  const auto failed = std::ranges::find_if(outcome.verdicts, [](const Verdict& v) { return !v.ok; });
  if (failed != outcome.verdicts.end()) return answer("Not met", with_subscripts(failed->figure));
  const Verdict* tightest = nullptr;
  for (const Verdict& v : outcome.verdicts)
    if (room(v) && (!tightest || *room(v) < *room(*tightest))) tightest = &v;
  if (!tightest) return "";
  return answer("Closest requirement",
                fmt::format("{}: {}", with_subscripts(tightest->figure), escaped(room_words(*tightest))));
}

/// The used part of the bus voltage, if no two consecutive samples used all of it.
std::string least_of_bus(double largest_duty, bool legs) {
  constexpr double whole = 1.0 - 1e-6;
  if (largest_duty >= whole) return "full voltage only at single samples";
  return fmt::format("full voltage was never needed; {} {}",
                     legs ? "largest voltage vector, relative to its circle:" : "largest duty",
                     plain(largest_duty, 3));
}

std::string limits(const Scenario& scenario, const Outcome& outcome, const Trace& trace) {
  std::string text = closest(outcome);
  if (const auto held = held_back(trace, scenario)) {
    const auto lasted = [&](double seconds) {
      const std::string seen = trace.whole.empty() ? "the run" : "its last " + computed(held->seen_s, "s");
      return fmt::format("<b>{}</b>, {} of {}", computed(seconds, "s"),
                         in_percent(seconds / (trace.whole.empty() ? outcome.simulated_s : held->seen_s)),
                         seen);
    };
    const bool legs = scenario.control.drive == sixstep::study::FirmwareKind::field;
    text += answer("Bus voltage", held->bus_s > 0.0 ? "full voltage for " + lasted(held->bus_s)
                                                    : least_of_bus(held->largest_duty, legs));
    if (held->limit_A)
      text += answer(
          "Current limit",
          held->limit_s > 0.0
              ? fmt::format("reference at {} during {}", computed(*held->limit_A, "A"), lasted(held->limit_s))
              : computed(*held->limit_A, "A") + ", never reached by the reference");
  }
  if (text.empty()) text = answer("Limits", "the run has no requirements and no commanded duty");
  return card("limits", "What limits the drive", list(text));
}

std::string loop(const LoopGains& g, bool linear) {
  if (g.loop == "position" && linear)
    return plain(g.d1 / sixstep::base::in_linear("deg").factor, 4, true) + "\u00a0m/s per mm, " +
           escaped(g.origin);
  if (g.loop == "position") return plain(g.d1, 4, true) + "\u00a0rad/s per degree, " + escaped(g.origin);
  if (!g.steps.empty())
    return fmt::format("<b>K {}</b> {}<br>{}", plain(g.d1, 5, true), gain_unit(g, linear), escaped(g.origin));
  std::string text = fmt::format("<b>d<sub>1</sub> {}, d<sub>0</sub> {}</b> {}<br>{}", plain(g.d1, 5, true),
                                 plain(g.d0, 5, true), gain_unit(g, linear), escaped(g.origin));
  if (!g.derivation) return text;
  const auto& design = *g.derivation;
  const bool as_designed = std::abs(g.d1 - design.gains.d1) <= 1e-12 * std::abs(g.d1);
  text += as_designed ? fmt::format(": {}, ξ {}", given(design.settle_s, "s"), plain(design.damping, 3, true))
                      : fmt::format("; pole placement gives {}, {}", plain(design.gains.d1, 5, true),
                                    plain(design.gains.d0, 5, true));
  return text;
}

std::string own_numbers(const Scenario& scenario) {
  std::string text = "your own";
  for (const sixstep::study::UsedNumber& number : sixstep::study::used_numbers(scenario.control.own))
    text += fmt::format("<br>{} {}{}", escaped(number.is->name),
                        escaped(given(number.value, number.is->unit)), number.preset ? " (preset)" : "");
  return text;
}

std::string gains(const Scenario& scenario, const Outcome& outcome) {
  using sixstep::control::Mode;
  const auto& inner = scenario.control.current;
  std::string text;
  if (scenario.control.mode >= Mode::current && inner.type == sixstep::study::CurrentLoopType::hysteresis)
    text += answer("Current loop", "<b>hysteresis, ±" + computed(inner.band_A, "A") + "</b>");
  for (const LoopGains& g : outcome.gains)
    text +=
        answer(escaped(g.loop + " loop"), loop(g, outcome.motor.kind == sixstep::design::MotorKind::linear));
  if (text.empty())
    text = answer("Controller", scenario.control.drive == sixstep::study::FirmwareKind::own
                                    ? own_numbers(scenario)
                                    : without_gains(scenario));
  if (!outcome.gains.empty()) text += "<div class=\"more\"><a href=\"#gains\">Derivation</a></div>";
  return card("tuned", "Gains", list(text));
}

/// The controlled current and its reference over the step; time counts from the step.
std::string step_chart(const Trace& trace, const Step& step) {
  constexpr std::size_t rows_drawn = 600;
  const auto* time = find_column(trace, "t_s");
  const HeldCurrent& held = step.held;
  const auto current = held_values(trace, held), reference = asked_values(trace, held);
  if (!time || !current) return "";
  const auto begin = std::ranges::lower_bound(*time, step.window.from) - time->begin();
  const auto end = std::ranges::upper_bound(*time, step.window.to) - time->begin();
  const auto part = [&](const std::vector<double>& column) {
    return std::span(column).subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin));
  };
  Curves curves{part(*current)};
  if (reference) curves.push_back(part(*reference));
  const Scale in = scale_for(step.window.to - step.window.from, "s");
  SvgChart chart{.title = held.title,
                 .x_label = in.unit + (step.of == "start" ? " after the start" : " after the step"),
                 .y_label = "A",
                 .compact = true};
  const Thinned kept = thinned(part(*time), curves, {}, rows_drawn, rows_drawn);
  const auto drawn = [&](const char* label, const char* style, std::span<const double> values) {
    SvgCurve curve{.label = label, .style = style};
    for (const std::size_t n : kept.rows) {
      curve.x.push_back((part(*time)[n] - step.at_s) * in.factor);
      curve.y.push_back(values[n]);
    }
    chart.curves.push_back(curve);
  };
  drawn(held.label, "main", curves[0]);
  if (reference) drawn(held.reference_label, "reference", curves[1]);
  return svg_chart(chart);
}

/// During a commutation, the motor current is not the current of any phase.
constexpr const char* of_the_pair =
    "<p class=\"quiet\">The motor current is half the difference of the driven pair's two currents. When the pair "
    "changes, the new phase has no current yet, and the motor current falls by up to half.</p>";

/// The current in the window of the step, then the current until the next step.
std::string step_sentences(const Step& step, const StepCurrent& current, double end_s) {
  const bool asked = step.of != "start";
  const std::string shown = computed(step.window.to - step.at_s, "s");
  // A current of no more than rounding errors is 0.
  const auto ampere = [&current](double x) {
    return computed(std::abs(x) < 1e-9 * std::abs(current.peak_A) ? 0.0 : x, "A");
  };
  std::string text = fmt::format("In the first {} {}: peak <b>{}</b> after {}", shown,
                                 asked ? "after the step" : "of the run", ampere(current.peak_A),
                                 computed(current.peak_after_s, "s"));
  if (current.asked_A && step.of != "current")
    text += fmt::format(" (reference then: {})", ampere(*current.asked_A));
  text += fmt::format(", {} rms.", ampere(current.rms_A));
  if (current.then_mean_A)
    text += fmt::format(" From then until the {}: {} on average, between {} and {}.",
                        step.next_s < end_s ? "next step" : "end", ampere(*current.then_mean_A),
                        ampere(current.then_low_A), ampere(current.then_high_A));
  return "<p>" + text + "</p>" + (step.held.column == std::string_view("i_m_A") ? of_the_pair : "");
}

std::string step(const Scenario& scenario, const Trace& trace) {
  const auto found = largest_step(trace, scenario);
  const auto current = found ? step_current(trace, *found) : std::nullopt;
  if (!current) return "";
  const bool asked = found->of != "start";
  const bool linear = scenario.sheet.kind == sixstep::design::MotorKind::linear;
  const sixstep::base::LinearUnit unit =
      linear ? sixstep::base::in_linear(found->unit) : sixstep::base::LinearUnit{found->unit, found->unit};
  const auto level = [&unit](double x) { return given(x * unit.factor, std::string(unit.linear)); };
  const std::string title =
      asked ? fmt::format(
                  "{} from {} to {}",
                  found->of == "current" ? "Current in its step" : "Current in the step of " + found->of,
                  level(found->from), level(found->to)) +
                  (found->index != 0.0 ? ", " + level(found->to - found->index) + " from the encoder's index"
                                       : "")
            : std::string("Current of the run");
  const double end_s = find_column(trace, "t_s")->back();
  return card("step", title, step_sentences(*found, *current, end_s) + step_chart(trace, *found));
}

std::string cost(const Outcome& outcome, const Trace& trace) {
  const std::string content = cost_content(outcome, trace);
  return content.empty() ? "" : card("cost", "Costs", content);
}

}  // namespace

std::string glance_section(const Scenario& scenario, const Outcome& outcome, const Trace& trace) {
  return "<div class=\"glance\">\n<div>" + limits(scenario, outcome, trace) + gains(scenario, outcome) +
         "</div>\n" + step(scenario, trace) + cost(outcome, trace) + "</div>\n";
}

}  // namespace report
