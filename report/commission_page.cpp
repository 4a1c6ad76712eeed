// SPDX-License-Identifier: Apache-2.0
#include "report/commission_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <report_assets.hpp>

#include "report/bench_facts.hpp"
#include "report/figures.hpp"
#include "report/html.hpp"
#include "report/shell.hpp"
#include "text/escape/escape.hpp"
#include "text/results/commission_text.hpp"

namespace report {
namespace {

using sixstep::analysis::CommissionPhase;
using sixstep::analysis::CommissionRow;
using sixstep::analysis::CommissionStudy;
using Phase = sixstep::control::CommissioningPhase;

std::string with_bound(double x, double bound, std::string_view unit) {
  return x > 0.0 ? fmt::format("{} ± {:.2g} %", computed(x, unit), 100 * bound) : "not found";
}

std::string facts(const CommissionStudy& s) {
  std::string out = bench_fact("Resistance", with_bound(s.found.R_ohm, s.bounds.R_part, "ohm")) +
                    bench_fact("Inductance", with_bound(s.found.L_H, s.bounds.L_part, "H")) +
                    bench_fact("Flux linkage", with_bound(s.found.flux_linkage_Vs, s.bounds.flux_part, "Wb"));
  out += bench_fact("Hall offset",
                    s.lines_found()
                        ? fmt::format("{:.2f}° ± {:.2g}°", s.found.hall_offset_deg + 0.0, s.bounds.edge_deg)
                        : "not found");
  return out +
         bench_fact("Verdict", s.holds() ? "all within bounds" : "not all values are within their bounds");
}

/// The interval from the start of phase `first` to the end of phase `last`.
CommissionPhase span_of(const CommissionStudy& s, Phase first, Phase last) {
  CommissionPhase out{.phase = first, .from_s = 0.0, .to_s = 0.0};
  bool any = false;
  for (const CommissionPhase& p : s.phases) {
    if (p.phase < first || p.phase > last) continue;
    if (!any) out.from_s = p.from_s;
    any = true;
    out.to_s = p.to_s;
  }
  return out;
}

/// The stride that reduces the rows of the span to about 1500 points.
std::size_t stride_of(const CommissionStudy& s, const CommissionPhase& span) {
  constexpr double points = 1500.0;
  const double rows = s.rows.empty() ? 0.0
                                     : static_cast<double>(s.rows.size()) * (span.to_s - span.from_s) /
                                           std::max(s.rows.back().t_s, 1e-9);
  return static_cast<std::size_t>(std::max(1.0, rows / points));
}

/// A curve of the rows in a span of time.
template <class Value>
SvgCurve curve_of(const CommissionStudy& s, const CommissionPhase& span, const char* label, const char* style,
                  Value value) {
  SvgCurve curve{label, style, {}, {}};
  const std::size_t stride = stride_of(s, span);
  std::size_t n = 0;
  for (const CommissionRow& row : s.rows) {
    if (row.t_s < span.from_s || row.t_s > span.to_s || n++ % stride != 0) continue;
    curve.x.push_back(row.t_s);
    curve.y.push_back(value(row));
  }
  return curve;
}

std::string currents(const CommissionStudy& s, const char* title, Phase first, Phase last) {
  const CommissionPhase span = span_of(s, first, last);
  SvgChart chart{.title = title, .x_label = "s", .y_label = "A", .levels = {0.0}};
  constexpr const char* legs[] = {"leg a", "leg b", "leg c"};
  for (std::size_t leg = 0; leg < 3; ++leg)
    chart.curves.push_back(curve_of(s, span, legs[leg], curve_styles[leg],
                                    [leg](const CommissionRow& row) { return row.i_A[leg]; }));
  return svg_chart(chart);
}

std::string way(const CommissionStudy& s) {
  SvgChart chart{.title = "The rotor's path", .x_label = "s", .y_label = "electrical turns", .levels = {0.0}};
  chart.curves.push_back(curve_of(s, span_of(s, Phase::zeroing, Phase::turning), "rotor", "main",
                                  [](const CommissionRow& row) { return row.turns; }));
  return svg_chart(chart);
}

}  // namespace

std::string render_commission(const CommissionPage& page) {
  const CommissionStudy& s = page.study;
  const std::string title = escaped(text::visible("Results of the chip on " + s.subject.sheet.name));
  const std::string body = filled(
      assets::bench_html(),
      {{"title", title},
       {"subtitle", escaped(fmt::format("{} of test current{}, {}", computed(s.bench.wish.test_A, "A"),
                                        text::stand_in_words(s.bench), computed(s.seconds, "s")))},
       {"facts", facts(s)},
       {"pictured", "The test"},
       {"charts",
        currents(s, "Currents until the rotor rests, then steps between two current levels", Phase::zeroing,
                 Phase::stepping) +
            way(s) +
            currents(s, "Currents while the field turns slowly, each way", Phase::turning, Phase::turning) +
            currents(s, "Currents of the fast turn", Phase::spinning, Phase::measuring)},
       {"text", escaped(text::commission_text(s))}});
  return in_shell({.title = title, .body = body, .command = page.command, .version = page.version});
}

}  // namespace report
