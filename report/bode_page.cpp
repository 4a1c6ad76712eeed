// SPDX-License-Identifier: Apache-2.0
#include "report/bode_page.hpp"

#include <fmt/format.h>

#include <cmath>
#include <report_assets.hpp>

#include "report/bench_facts.hpp"
#include "report/design_charts.hpp"
#include "report/html.hpp"
#include "report/shell.hpp"
#include "report/svg_chart.hpp"
#include "sixstep/base/angle.hpp"
#include "text/escape/escape.hpp"
#include "text/results/bode_text.hpp"

namespace report {
namespace {

using sixstep::analysis::BodeStudy;
using sixstep::analysis::LoopPoint;

/// Frequencies of the designed curve: the measured frequencies, and frequencies between them for a smooth
/// curve.
std::vector<double> frequencies(const BodeStudy& s) {
  constexpr int between = 8;
  std::vector<double> w;
  for (std::size_t k = 0; k + 1 < s.points.size(); ++k) {
    const double from = s.points[k].w_rad_s, ratio = s.points[k + 1].w_rad_s / from;
    for (int n = 0; n < between; ++n) w.push_back(from * std::pow(ratio, double(n) / between));
  }
  if (!s.points.empty()) w.push_back(s.points.back().w_rad_s);
  return w;
}

/// Adds the designed curves. The designed phase starts within half a turn of the first measured phase and
/// continues without jumps.
void add_designed(const BodeStudy& s, SvgChart& gain, SvgChart& phase) {
  if (!s.designed || s.points.empty()) return;
  SvgCurve g{"designed", "reference", {}, {}}, p{"designed", "reference", {}, {}};
  double last = s.designed_phase_rad.front();
  for (const double w : frequencies(s)) {
    const auto L = *s.designed_at(w);
    last = sixstep::analysis::next_to(L.angle_rad(), last);
    g.x.push_back(w / sixstep::base::turn_rad);
    p.x.push_back(w / sixstep::base::turn_rad);
    g.y.push_back(20 * std::log10(L.size()));
    p.y.push_back(last / sixstep::base::rad_per_deg);
  }
  gain.curves.push_back(std::move(g));
  phase.curves.push_back(std::move(p));
}

std::string charts(const BodeStudy& s) {
  auto [gain, phase] = BodeCharts{};
  SvgChart closed{
      .title = "Closed loop |T|", .x_label = "Hz", .y_label = "dB", .log_x = true, .levels = {-3.0}};
  SvgChart coherence{.title = "Coherence", .x_label = "Hz", .log_x = true, .levels = {1.0}};
  SvgCurve g{"measured", "a", {}, {}}, p = g, t = g, c = g;
  for (const LoopPoint& point : s.points) {
    for (SvgCurve* curve : {&g, &p, &t, &c}) curve->x.push_back(point.w_rad_s / sixstep::base::turn_rad);
    g.y.push_back(20 * std::log10(point.gain));
    p.y.push_back(point.phase_rad / sixstep::base::rad_per_deg);
    t.y.push_back(20 * std::log10(point.closed.size()));
    c.y.push_back(point.coherence);
  }
  gain.curves.push_back(std::move(g));
  phase.curves.push_back(std::move(p));
  closed.curves.push_back(std::move(t));
  coherence.curves.push_back(std::move(c));
  add_designed(s, gain, phase);
  return svg_chart(gain) + svg_chart(phase) + svg_chart(closed) + svg_chart(coherence);
}

/// Replaces ASCII spellings in the terminal's text by typographic signs, such as +- by ±.
std::string in_print(std::string text) {
  const auto put = [&text](std::string_view from, std::string_view to) {
    for (std::size_t at = text.find(from); at != text.npos; at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
  };
  put("+-", "±");
  put(" us", " µs");
  return text;
}

std::string facts(const BodeStudy& s) {
  std::string out;
  for (const text::BodeMargin& m : text::bode_margins(s))
    out += bench_fact(
        m.name, in_print(s.designed ? fmt::format("{} (designed {})", m.measured, m.designed) : m.measured));
  return out;
}

}  // namespace

std::string render_bode(const BodePage& page) {
  const std::string title = escaped(text::visible("Frequency response of " + page.name));
  const std::string body =
      filled(assets::bench_html(), {{"title", title},
                                    {"subtitle", escaped(in_print(text::bode_place(page.study)))},
                                    {"facts", facts(page.study)},
                                    {"pictured", "Measured on the switching simulation"},
                                    {"charts", charts(page.study)},
                                    {"text", escaped(in_print(text::bode_text(page.name, page.study)))}});
  return in_shell({.title = title, .body = body, .command = page.command, .version = page.version});
}

}  // namespace report
