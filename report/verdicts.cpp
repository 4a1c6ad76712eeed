// SPDX-License-Identifier: Apache-2.0
#include "report/verdicts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/figures.hpp"
#include "report/html.hpp"
#include "text/results/verdict_table.hpp"

namespace report {
namespace {

using sixstep::study::Outcome;
using sixstep::study::Verdict;

std::string with_aside(const std::string& main, const std::string& extra) {
  return extra.empty() ? main : fmt::format("{}<small class=\"aside\">{}</small>", main, extra);
}

/// A small scale with the allowed range shaded and a mark at the measured value. Limits are at 20 and 80 % of
/// the width, so that a value beyond a limit is also visible.
std::string gauge(const Verdict& v) {
  if (!std::isfinite(v.measured) || (!v.min && !v.max)) return "";
  double low = 0.0, high = 80.0, at = 0.0;  // positions of the allowed range and of the mark, in per cent of
                                            // the width
  if (v.min && v.max) {
    const double width = *v.max - *v.min;
    low = 20.0;
    at = width > 0.0 ? 20.0 + 60.0 * (v.measured - *v.min) / width : 50.0;
  } else if (v.max) {
    const double limit = *v.max - v.zero;
    at = limit > 0.0 ? 80.0 * (v.measured - v.zero) / limit : v.measured <= *v.max ? 40.0 : 100.0;
  } else {
    low = 20.0;
    high = 100.0;
    const double limit = *v.min - v.zero;
    at = limit > 0.0 ? 20.0 * (v.measured - v.zero) / limit : v.measured >= *v.min ? 60.0 : 0.0;
  }
  return fmt::format(
      "<span class=\"gauge\" aria-hidden=\"true\"><i style=\"left:{:.1f}%;width:{:.1f}%\"></i>"
      "<b style=\"left:{:.1f}%\"></b></span>",
      low, high - low, std::clamp(at, 0.0, 100.0));
}

}  // namespace

Standing standing(const Outcome& outcome) {
  const auto count = outcome.verdicts.size();
  const auto held = std::ranges::count_if(outcome.verdicts, [](const Verdict& v) { return v.ok; });
  if (outcome.fault)
    return {"fail", "FAIL",
            outcome.trip ? fmt::format("a fault stopped the drive at {}", given(outcome.trip->at_s, "s"))
                         : fmt::format("a fault stopped the run at {}", given(outcome.simulated_s, "s"))};
  if (count == 0) return {"none", "NO REQUIREMENT", "the run ended as planned; it has no requirements"};
  const std::string line = count == 1
                               ? (held == 1 ? "the requirement holds" : "the requirement does not hold")
                               : fmt::format("{} of {} requirements hold", held, count);
  return outcome.passed() ? Standing{"pass", "PASS", line} : Standing{"fail", "FAIL", line};
}

std::optional<double> room(const Verdict& v) {
  if (!std::isfinite(v.measured)) return std::nullopt;
  if (v.min && v.max) {
    const double half = (*v.max - *v.min) / 2;
    if (!(half > 0.0)) return std::nullopt;
    return std::min(*v.max - v.measured, v.measured - *v.min) / half;
  }
  const double limit = v.max ? *v.max : v.min.value_or(0.0);
  if (limit == v.zero) return std::nullopt;
  return (v.max ? limit - v.measured : v.measured - limit) / std::abs(limit - v.zero);
}

std::string room_words(const Verdict& v) {
  if (v.min && v.max)
    return computed(std::min(*v.max - v.measured, v.measured - *v.min), difference_unit(v.unit)) +
           " from the nearer limit";
  const std::string left = v.unit == "degC" ? computed(v.max ? *v.max - v.measured : v.measured - *v.min, "K")
                                            : plain(100.0 * *room(v), 2, true) + "\u00a0%";
  return left + " inside its " + (v.max ? "upper" : "lower") + " limit";
}

std::string requirement_rows(const Outcome& outcome) {
  std::string html;
  for (const Verdict& v : outcome.verdicts) {
    const Judged shown = judged(v.measured, v.min, v.max, v.unit);
    html += fmt::format(
        "<tr class=\"{}\"><td class=\"mark\">{}</td><th scope=\"row\">{}</th><td class=\"num\">{}</td>"
        "<td class=\"num strong\">{}</td><td>{}</td></tr>\n",
        v.ok ? "ok" : "bad", v.ok ? "<span>✓</span> ok" : "<span>✗</span> not met", with_subscripts(v.figure),
        escaped(shown.required), with_aside(escaped(shown.measured), aside(v.measured, v.unit)), gauge(v));
  }
  return html;
}

std::string comparison_rows(const Outcome& outcome) {
  std::string html;
  for (const auto& c : outcome.comparisons) {
    const Scale scale = scale_for(c.value != 0.0 ? c.value : c.measured, c.unit);
    const std::string space = scale.unit.empty() || scale.unit == "°" ? "" : "\u00a0";
    const auto show = [&](double value, int digits, bool trim) {
      if (never(value, c.unit)) return std::string("never");
      return escaped(plain(value * scale.factor, digits, trim) + space + scale.unit);
    };
    html += fmt::format(
        "<tr><th scope=\"row\">{}</th><td class=\"num\">{}</td><td class=\"num strong\">{}</td>"
        "<td class=\"num\">{}</td><td class=\"source\">{}</td></tr>\n",
        with_subscripts(c.figure), with_aside(show(c.value, 7, true), aside(c.value, c.unit)),
        with_aside(show(c.measured, 4, false), aside(c.measured, c.unit)),
        escaped(c.uncertainty ? text::recorded_verdict(c) : deviation(c.measured, c.value, c.unit)),
        with_subscripts(c.source));
  }
  return html;
}

}  // namespace report
