// SPDX-License-Identifier: Apache-2.0
#include "report/design_charts.hpp"

#include <cmath>

#include "report/svg_chart.hpp"
#include "sixstep/base/angle.hpp"
#include "sixstep/design/sheet/motion.hpp"

namespace report {
namespace {

using sixstep::analysis::DesignStudy;
using sixstep::control::Mode;
using sixstep::design::DriveDesign;

const std::vector<double>* column(const DesignStudy& s, std::string_view name) {
  for (std::size_t n = 0; n < s.trace.columns.size(); ++n)
    if (s.trace.columns[n].name == name) return &s.trace.values[n];
  return nullptr;
}

/// The end of the drawn time: three settling times after the step. A position move is drawn completely.
double end_of_view(const DesignStudy& s, double begin_s) {
  const double settle = s.design.loops.back().step.settling_s;
  const bool whole = s.design.spec.mode == Mode::position || !std::isfinite(settle);
  return whole ? s.scenario.duration_s : std::fmin(s.scenario.duration_s, begin_s + 3 * settle);
}

/// A speed step occurs after the start of the drive, so the time axis begins at the step.
constexpr const char* behind_the_start = "ms from the step on";

/// The step response of the linear loop, added to the value at the start of the step.
SvgCurve designed(const DesignStudy& s, double begin_s, double from, double height) {
  SvgCurve curve{"designed", "reference", {}, {}};
  const auto& samples = s.design.loops.back().step.samples;
  for (std::size_t n = 0; n < samples.size(); ++n) {
    const double t = begin_s + static_cast<double>(n) * s.design.spec.period_s;
    if (t > end_of_view(s, begin_s)) break;
    curve.x.push_back((t - begin_s) * 1e3);
    curve.y.push_back(from + height * samples[n]);
  }
  return curve;
}

SvgCurve simulated(const DesignStudy& s, std::string_view name, double begin_s, double factor) {
  SvgCurve curve{"simulated", "a", {}, {}};
  const std::vector<double>*t = column(s, "t_s"), *y = column(s, name);
  for (std::size_t n = 0; t && y && n < t->size(); ++n) {
    if ((*t)[n] < begin_s || (*t)[n] > end_of_view(s, begin_s)) continue;
    curve.x.push_back(((*t)[n] - begin_s) * 1e3);
    curve.y.push_back((*y)[n] * factor);
  }
  return curve;
}

}  // namespace

std::string step_charts(const DesignStudy& s) {
  const auto& r = s.scenario.reference;
  const sixstep::base::Motion motion = motion_of(s.design.motor);
  SvgChart chart{.title = "Step", .x_label = "ms"};
  if (s.design.spec.mode == Mode::current) {
    chart.y_label = "A";
    chart.curves = {simulated(s, "i_m_A", 0, 1), designed(s, 0, 0, r.value)};
    chart.levels = {r.value};
  } else if (s.design.spec.mode == Mode::speed) {
    chart.y_label = motion.unit("rad/s").linear;
    chart.x_label = behind_the_start;
    const double begin = r.times_s.at(1), from = r.values.at(0), to = r.values.at(1);
    chart.curves = {simulated(s, motion.words("speed_rad_s"), begin, 1), designed(s, begin, from, to - from)};
    chart.levels = {to};
  } else {
    const sixstep::base::LinearUnit deg = motion.unit("deg");
    const double height = r.value * deg.factor;
    chart.y_label = deg.linear;
    chart.title = "Move";
    chart.curves = {motion.linear ? simulated(s, "position_mm", 0, 1)
                                  : simulated(s, "angle_rad", 0, 1 / sixstep::base::rad_per_deg),
                    designed(s, 0, 0, height)};
    chart.curves[1].label = "as designed, without limits";
    chart.levels = {height};
  }
  if (s.design.spec.mode == Mode::current) return svg_chart(chart);
  const double begin = s.design.spec.mode == Mode::speed ? r.times_s.at(1) : 0.0;
  return svg_chart(chart) + svg_chart({.title = "Motor current",
                                       .x_label = chart.x_label,
                                       .y_label = "A",
                                       .curves = {simulated(s, "i_m_A", begin, 1)},
                                       .levels = {}});
}

std::string loop_charts(const DesignStudy& s) {
  auto [gain, phase] = BodeCharts{};
  std::size_t n = 0;
  for (const auto& loop : s.design.loops) {
    const double from = loop.figures.crossover_rad_s.value_or(0.1 / s.design.spec.period_s) / 30;
    SvgCurve& g = gain.curves.emplace_back(SvgCurve{loop.name, curve_styles[n % 3], {}, {}});
    SvgCurve& p = phase.curves.emplace_back(SvgCurve{loop.name, curve_styles[n % 3], {}, {}});
    for (const auto& point : sixstep::design::bode(loop.loop, s.design.spec.period_s, from, 240)) {
      const double deg = point.phase_rad / sixstep::base::rad_per_deg;
      // Below this gain or phase, the curves have no meaning for the stability margins.
      const bool shown = point.gain > 1e-3 && deg > -400;
      g.x.push_back(point.w_rad_s / sixstep::base::turn_rad);
      g.y.push_back(shown ? 20 * std::log10(point.gain) : NAN);
      p.y.push_back(shown ? deg : NAN);
    }
    p.x = g.x;
    ++n;
  }
  return svg_chart(gain) + svg_chart(phase);
}

std::string limit_charts(const DesignStudy& s) {
  const DriveDesign& d = s.design;
  SvgChart headroom{.title = "Voltage left",
                    .x_label = std::string(motion_of(d.motor).unit("rad/s").linear),
                    .y_label = "V",
                    .levels = {0.0}};
  const double top = d.bus_V / d.motor.K_t_Nm_A;
  std::size_t n = 0;
  const char* const loaded = d.nominal_printed ? "nominal current" : "a tenth of stall";
  for (const double part : {0.0, 1.0}) {
    SvgCurve curve{part == 0 ? "no current" : loaded, curve_styles[n++], {0, top}, {}};
    for (const double w : curve.x)
      curve.y.push_back(sixstep::design::headroom_V(d.motor, d.bus_V, part * d.nominal_current_A, w));
    headroom.curves.push_back(std::move(curve));
  }
  SvgChart ripple{.title = "Current ripple, peak to peak", .x_label = "duty", .y_label = "A"};
  SvgCurve curve{"PWM", "a", {}, {}};
  for (int k = 0; k <= 100; ++k) {
    curve.x.push_back(k / 100.0);
    curve.y.push_back(
        sixstep::design::current_ripple_A(d.motor, d.bus_V, d.spec.period_s, d.spec.chopping, k / 100.0));
  }
  ripple.curves.push_back(std::move(curve));
  return svg_chart(headroom) + svg_chart(ripple);
}

}  // namespace report
