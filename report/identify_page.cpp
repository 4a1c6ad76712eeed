// SPDX-License-Identifier: Apache-2.0
#include "report/identify_page.hpp"

#include <fmt/format.h>

#include <bit>
#include <report_assets.hpp>

#include "report/bench_facts.hpp"
#include "report/figures.hpp"
#include "report/html.hpp"
#include "report/shell.hpp"
#include "text/escape/escape.hpp"
#include "text/results/hall_words.hpp"
#include "text/results/identify_text.hpp"
#include "text/results/interval_text.hpp"

namespace report {

std::string bench_fact(std::string_view name, const std::string& value) {
  return fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", name, escaped(value));
}

namespace {

using sixstep::analysis::EdgePassage;
using sixstep::analysis::HallIdentity;
using sixstep::analysis::IdentifiedEdge;

/// The pin whose level changes at the edge: 0, 1 or 2.
std::size_t pin_of(const IdentifiedEdge& e) {
  return 2 - static_cast<std::size_t>(std::countr_zero(static_cast<unsigned>(e.before ^ e.after)));
}
bool rises(const IdentifiedEdge& e) { return e.after > e.before; }

std::string facts(const HallIdentity& f) {
  std::string out;
  if (f.place) {
    const auto& p = *f.place;
    out += bench_fact(
        "Lines", text::wires_words(p.wires.front()) + ", sure to " + text::certainty_text(p.probability));
    out += bench_fact("Turned", p.forward ? "forward" : "backward");
    out += bench_fact("Offset", text::with_bounds(p.offset_deg, "°"));
    if (p.hysteresis_deg) out += bench_fact("Hysteresis", text::with_bounds(*p.hysteresis_deg, "°"));
    out += bench_fact("Flux linkage",
                      text::with_bounds(sixstep::analysis::scaled(p.flux_linkage_Vs, 1e3), "mWb"));
  } else {
    out += bench_fact("Codes never seen", text::code_word(f.mask) + " and " +
                                              text::code_word(static_cast<std::uint8_t>(f.mask ^ 7)));
    out += bench_fact("Order and offset", "Hall codes do not show these values");
  }
  out += bench_fact("Jitter", f.jitter_deg.low > 0.0 ? text::with_bounds(f.jitter_deg, "° rms")
                                                     : fmt::format("≤ {:.2g}° rms", f.jitter_deg.high));
  return out;
}

/// Deviations of the rising or of the falling edges over time, with one colour per pin.
SvgChart passages(const HallIdentity& f, bool rising) {
  SvgChart chart{.title = rising ? "Rising edges in the order of time" : "Falling edges in the order of time",
                 .x_label = "s",
                 .y_label = "deviation from the nominal angle, electrical degrees",
                 .levels = {0.0}};
  // Without voltages the absolute angle is unknown; the mean of all edges is then drawn as zero.
  double level = 0.0, count = 0.0;
  for (const EdgePassage& p : f.passages)
    if (!f.place && !p.left_out) level += p.place_deg - f.edges[p.edge].own_deg.value, count += 1.0;
  level /= std::max(count, 1.0);
  const std::size_t stride = thinned_stride(f.passages.size() / 6) * f.edges.size() / 6;
  for (std::size_t pin = 0; pin < 3; ++pin) {
    SvgCurve curve{fmt::format("H{}", pin + 1), curve_styles[pin], {}, {}};
    std::size_t seen = 0;
    for (const EdgePassage& p : f.passages) {
      const IdentifiedEdge& e = f.edges[p.edge];
      if (pin_of(e) != pin || rises(e) != rising || p.left_out ||
          seen++ % std::max<std::size_t>(stride, 1) != 0)
        continue;
      curve.x.push_back(p.t_s - f.passages.front().t_s);
      curve.y.push_back(p.place_deg - level);
    }
    chart.curves.push_back(std::move(curve));
  }
  return chart;
}

SvgChart speed(const HallIdentity& f) {
  SvgChart chart{.title = "Speed", .x_label = "s", .y_label = "electrical turns per second", .levels = {0.0}};
  SvgCurve curve{"rotor", "main", {}, {}};
  const std::size_t stride = thinned_stride(f.passages.size());
  for (std::size_t n = 0; n < f.passages.size(); n += stride) {
    if (f.passages[n].begins && n > 0) curve.x.push_back(NAN), curve.y.push_back(NAN);
    curve.x.push_back(f.passages[n].t_s - f.passages.front().t_s);
    curve.y.push_back(f.passages[n].speed_deg_s / 360.0);
  }
  chart.curves.push_back(std::move(curve));
  return chart;
}

SvgChart own_places(const HallIdentity& f) {
  SvgChart chart{
      .title = "Angle of each edge, 95 %",
      .x_label = f.place ? "nominal angle, electrical degrees" : "electrical degrees, from any edge on",
      .y_label = "degrees",
      .levels = {0.0}};
  const double step = 360.0 / 6.0, half = 0.15 * step;
  for (std::size_t pin = 0; pin < 3; ++pin) {
    SvgCurve curve{fmt::format("H{}", pin + 1), curve_styles[pin], {}, {}};
    for (std::size_t n = 0; n < f.edges.size(); ++n) {
      const IdentifiedEdge& e = f.edges[n];
      if (pin_of(e) != pin) continue;
      const double x = step * static_cast<double>(n);
      add_bar(curve, x, e.own_deg.low, e.own_deg.high);
      curve.x.insert(curve.x.end(), {x - half, x + half, NAN});
      curve.y.insert(curve.y.end(), {e.own_deg.value, e.own_deg.value, NAN});
    }
    chart.curves.push_back(std::move(curve));
  }
  return chart;
}

}  // namespace

std::string render_identify(const IdentifyPage& page) {
  const HallIdentity& f = page.found;
  const std::string title = escaped(text::visible("Hall probes of " + page.name));
  const std::string body = filled(
      assets::bench_html(),
      {{"title", title},
       {"subtitle", escaped(fmt::format("{} edges in {}", f.forward + f.backward, computed(f.seconds, "s")))},
       {"facts", facts(f)},
       {"pictured", "Edge by edge"},
       {"charts", svg_chart(own_places(f)) + svg_chart(speed(f)) + svg_chart(passages(f, true)) +
                      svg_chart(passages(f, false))},
       {"text", escaped(text::identify_text(page.name, f))}});
  return in_shell({.title = title, .body = body, .command = page.command, .version = page.version});
}

}  // namespace report
