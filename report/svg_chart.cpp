// SPDX-License-Identifier: Apache-2.0
#include "report/svg_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "report/html.hpp"

namespace report {
namespace {

constexpr double chart_left = 62, chart_right = 12, chart_top = 10, chart_bottom = 40;
struct Size {
  double width, height;
};
Size size_of(const SvgChart& chart) { return chart.compact ? Size{400, 210} : Size{640, 280}; }

/// Converts numbers to positions in the drawing.
class Axis {
 public:
  Axis(bool logarithmic, double from, double to) : logarithmic_(logarithmic), from_(from), to_(to) {}
  bool shows(double v) const { return std::isfinite(v) && (!logarithmic_ || v > 0); }
  void include(double v) {
    if (!shows(v)) return;
    low_ = std::min(low_, v);
    high_ = std::max(high_, v);
  }
  bool empty() const { return !(low_ <= high_); }
  /// Widens the range on each side by the fraction `part` of its span. The range of a flat curve is widened
  /// by 5 % of its value. A logarithmic axis is unchanged.
  void widen(double part) {
    if (logarithmic_) return;
    const double span = high_ - low_, size = std::max(std::abs(low_), std::abs(high_));
    const double room = span > 1e-9 * size ? span * part : std::max(0.05 * size, 1e-12);
    low_ -= room;
    high_ += room;
  }
  double at(double v) const {
    const double part =
        logarithmic_ ? std::log(v / low_) / std::log(high_ / low_) : (v - low_) / (high_ - low_);
    return from_ + part * (to_ - from_);
  }
  std::vector<double> ticks(double wanted) const {
    std::vector<double> out;
    if (logarithmic_) {
      const int last = static_cast<int>(std::floor(std::log10(high_) + 1e-9));
      for (int n = static_cast<int>(std::ceil(std::log10(low_) - 1e-9)); n <= last; ++n)
        out.push_back(std::pow(10.0, n));
      return out;
    }
    const double rough = (high_ - low_) / 5, power = std::pow(10.0, std::floor(std::log10(rough)));
    double step = power * 10;
    for (const double m : {5.0, 2.0, 1.0})
      if (power * m >= rough) step = power * m;
    if (wanted > 0.0) step = wanted * std::fmax(1.0, std::ceil((high_ - low_) / wanted / 9));
    const auto last = static_cast<long>(std::floor(high_ / step));
    for (auto n = static_cast<long>(std::ceil(low_ / step)); n <= last; ++n)
      out.push_back(static_cast<double>(n) * step);
    return out;
  }

 private:
  bool logarithmic_;
  double from_, to_;
  double low_ = std::numeric_limits<double>::infinity(), high_ = -std::numeric_limits<double>::infinity();
};

std::string label(double v) { return fmt::format("{:.6g}", v); }

std::string grid(const Axis& x, const Axis& y, const SvgChart& chart) {
  const auto [width, height] = size_of(chart);
  std::string out;
  for (const double v : x.ticks(0.0))
    out += fmt::format(
        "<line class=\"grid\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/><text x=\"{0:.1f}\" "
        "y=\"{3}\" text-anchor=\"middle\">{4}</text>\n",
        x.at(v), chart_top, height - chart_bottom, height - chart_bottom + 16, label(v));
  for (const double v : y.ticks(chart.y_tick))
    out += fmt::format(
        "<line class=\"grid\" x1=\"{1}\" x2=\"{2}\" y1=\"{0:.1f}\" y2=\"{0:.1f}\"/><text x=\"{3}\" "
        "y=\"{4:.1f}\" text-anchor=\"end\">{5}</text>\n",
        y.at(v), chart_left, width - chart_right, chart_left - 6, y.at(v) + 4, label(v));
  for (const double v : chart.levels)
    out += fmt::format("<line class=\"level\" x1=\"{1}\" x2=\"{2}\" y1=\"{0:.1f}\" y2=\"{0:.1f}\"/>\n",
                       y.at(v), chart_left, width - chart_right);
  out += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n",
                     (chart_left + width - chart_right) / 2, height - 6, escaped(chart.x_label));
  return out;
}

std::string path(const SvgCurve& c, const Axis& x, const Axis& y) {
  std::string d;
  bool pen = false;
  for (std::size_t n = 0; n < std::min(c.x.size(), c.y.size()); ++n) {
    const bool shown = x.shows(c.x[n]) && y.shows(c.y[n]);
    if (shown) d += fmt::format("{}{:.1f} {:.1f}", pen ? 'L' : 'M', x.at(c.x[n]), y.at(c.y[n]));
    pen = shown;
  }
  return fmt::format("<path class=\"{0}\" style=\"stroke:var(--{0})\" d=\"{1}\"/>\n", c.style, d);
}

/// Places each label to the right of its point, or to the right of a label that is already drawn there.
std::string marks(const SvgChart& chart, const Axis& x, const Axis& y) {
  constexpr double line = 12, letter = 7.5;
  struct Name {
    double from, to, row;
  };
  std::vector<Name> names;
  std::string out;
  for (const SvgMark& m : chart.marks) {
    const double row = y.at(m.y) + 4, length = letter * static_cast<double>(m.label.size() + 1);
    double from = x.at(m.x) + 8;
    for (const Name& n : names)
      if (std::abs(n.row - row) < line && from < n.to && n.from < from + length) from = n.to;
    names.push_back({from, from + length, row});
    out += fmt::format(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" style=\"fill:var(--{})\"/><text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
        x.at(m.x), y.at(m.y), m.style, from, row, escaped(m.label));
  }
  return out;
}

std::string caption(const SvgChart& chart) {
  std::string out = fmt::format("<figcaption><span class=\"name\">{}</span><span class=\"unit\">{}</span>",
                                escaped(chart.title), escaped(chart.y_label));
  for (const SvgCurve& c : chart.curves)
    out += fmt::format(
        "<span class=\"chip curve\"><span class=\"swatch{}\" "
        "style=\"border-color:var(--{})\"></span><span>{}</span></span>",
        c.style == "reference" ? " dashed" : "", c.style, with_subscripts(c.label));
  return out + "</figcaption>\n";
}

}  // namespace

std::string svg_chart(const SvgChart& chart) {
  const auto [width, height] = size_of(chart);
  Axis x(chart.log_x, chart_left, width - chart_right), y(chart.log_y, height - chart_bottom, chart_top);
  for (const SvgCurve& c : chart.curves)
    for (std::size_t n = 0; n < std::min(c.x.size(), c.y.size()); ++n)
      if (x.shows(c.x[n]) && y.shows(c.y[n])) {
        x.include(c.x[n]);
        y.include(c.y[n]);
      }
  for (const SvgMark& m : chart.marks)
    if (x.shows(m.x) && y.shows(m.y)) {
      x.include(m.x);
      y.include(m.y);
    }
  if (x.empty()) return "";
  if (!chart.marks.empty()) x.widen(0.1);
  for (const double v : chart.levels) y.include(v);
  y.widen(0.06);
  std::string out = "<figure class=\"chart drawn\">" + caption(chart);
  out += fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n", width, height,
                     escaped(chart.title));
  out += grid(x, y, chart);
  for (const SvgCurve& c : chart.curves) out += path(c, x, y);
  out += marks(chart, x, y);
  return out + "</svg></figure>\n";
}

}  // namespace report
