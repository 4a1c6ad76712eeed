// SPDX-License-Identifier: Apache-2.0
#include "report/emf_page.hpp"

#include <fmt/format.h>

#include <numbers>
#include <report_assets.hpp>

#include "report/bench_facts.hpp"
#include "report/html.hpp"
#include "report/shell.hpp"
#include "text/escape/escape.hpp"
#include "text/results/interval_text.hpp"

namespace report {
namespace {

using sixstep::analysis::EmfHarmonic;
using sixstep::analysis::EmfResult;

constexpr double per_cent = 100.0;

std::string facts(const text::MeasuredEmf& m) {
  const EmfResult& r = m.result;
  const double p = r.pole_pairs > 0 ? r.pole_pairs : 1.0;
  const char* const unit = r.pole_pairs > 0 ? "mV s/rad" : "mWb";
  std::string out = bench_fact("Frequency", text::with_bounds(r.frequency_Hz, "Hz"));
  out += bench_fact("Line, peak",
                    text::with_bounds(sixstep::analysis::scaled(r.constants.line_peak, 1e3 * p), unit));
  out += bench_fact("Phase, peak",
                    text::with_bounds(sixstep::analysis::scaled(r.constants.phase_peak, 1e3 * p), unit));
  out += bench_fact("Crest factor", fmt::format("{:.4g}; a sine has 1.414", r.crest));
  for (const sixstep::analysis::FrameCheck& c : m.checks)
    out += bench_fact(escaped(text::visible(c.key)),
                      fmt::format("{:g} {}, {}", c.printed, c.unit, c.holds() ? "fits" : "contradicts"));
  return out;
}

/// The recorded rows and the fit in the middle of the recording, at most three periods.
SvgChart recording(const EmfPage& page) {
  const EmfResult& r = page.measured.result;
  const auto& t = page.record.t_s;
  SvgChart chart{.title = "Recorded voltages and the fit", .x_label = "ms", .y_label = "V", .levels = {0.0}};
  const double middle = 0.5 * (t.front() + t.back()),
               half = std::min(1.5 / r.frequency_Hz.value, 0.5 * r.seconds);
  for (std::size_t c = 0; c < page.record.channels.size(); ++c) {
    SvgCurve seen{text::visible(page.record.channels[c].name), curve_styles[c], {}, {}},
        fit{c == 0 ? "fit" : "", "reference", {}, {}};
    const auto inside = static_cast<std::size_t>(static_cast<double>(t.size()) * 2.0 * half / r.seconds);
    const std::size_t stride = thinned_stride(inside);
    for (std::size_t n = 0; n < t.size(); n += stride) {
      if (t[n] < middle - half || t[n] > middle + half) continue;
      seen.x.push_back(1e3 * (t[n] - middle));
      seen.y.push_back(page.record.channels[c].u_V[n]);
      fit.x.push_back(seen.x.back());
      fit.y.push_back(sixstep::analysis::fitted_V(r.fit, c, t[n]));
    }
    chart.curves.push_back(std::move(seen));
    if (c == 0) chart.curves.push_back(std::move(fit));
  }
  return chart;
}

SvgChart residual(const EmfPage& page) {
  const auto& t = page.record.t_s;
  SvgChart chart{.title = "Residual of the fit", .x_label = "ms", .y_label = "V", .levels = {0.0}};
  for (std::size_t c = 0; c < page.record.channels.size(); ++c) {
    SvgCurve curve{text::visible(page.record.channels[c].name), curve_styles[c], {}, {}};
    for (std::size_t n = 0; n < t.size(); n += thinned_stride(t.size())) {
      curve.x.push_back(1e3 * (t[n] - t.front()));
      curve.y.push_back(page.record.channels[c].u_V[n] -
                        sixstep::analysis::fitted_V(page.measured.result.fit, c, t[n]));
    }
    chart.curves.push_back(std::move(curve));
  }
  return chart;
}

SvgChart harmonics(const EmfResult& r) {
  SvgChart chart{
      .title = "Harmonics, 95 %", .x_label = "order", .y_label = "% of the fundamental", .levels = {0.0}};
  SvgCurve bars{"measured", "a", {}, {}}, floor{"noise stays below", "reference", {}, {}};
  for (const EmfHarmonic& h : r.harmonics) {
    add_bar(bars, h.order, per_cent * h.part.low, per_cent * h.part.high);
    bars.x.insert(bars.x.end(), {h.order - 0.25, h.order + 0.25, NAN});
    bars.y.insert(bars.y.end(), {per_cent * h.part.value, per_cent * h.part.value, NAN});
    floor.x.push_back(h.order);
    floor.y.push_back(per_cent * h.floor);
  }
  chart.curves = {std::move(bars), std::move(floor)};
  return chart;
}

SvgChart shape(const EmfResult& r) {
  SvgChart chart{.title = "Shape of phase a",
                 .x_label = "electrical degrees",
                 .y_label = "relative to the peak",
                 .levels = {0.0}};
  SvgCurve measured{"measured", "a", r.angle_deg, r.shape}, sine{"sine", "reference", {}, {}};
  for (const double deg : r.angle_deg) {
    sine.x.push_back(deg);
    sine.y.push_back(std::cos((deg - 60.0) * std::numbers::pi / 180.0));
  }
  chart.curves = {std::move(measured), std::move(sine)};
  return chart;
}

}  // namespace

std::string render_emf(const EmfPage& page) {
  const EmfResult& r = page.measured.result;
  const std::string title = escaped(text::visible("Back-EMF of " + page.measured.name));
  const std::string body = filled(
      assets::bench_html(), {{"title", title},
                             {"subtitle", escaped(fmt::format("{:.3g} periods, {} rows", r.periods, r.rows))},
                             {"facts", facts(page.measured)},
                             {"pictured", "Recording and shape"},
                             {"charts", svg_chart(recording(page)) + svg_chart(residual(page)) +
                                            svg_chart(harmonics(r)) + svg_chart(shape(r))},
                             {"text", escaped(text::emf_text(page.measured))}});
  return in_shell({.title = title, .body = body, .command = page.command, .version = page.version});
}

}  // namespace report
