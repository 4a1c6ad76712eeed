// SPDX-License-Identifier: Apache-2.0
#include "report/wiring_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/html.hpp"

namespace report {
namespace {

using sixstep::analysis::WiringDoes;

constexpr double within = 0.3;  // in pixels; a smaller difference is not visible

double distance(const Place& p, const Place& a, const Place& b) {
  const double dx = b.x - a.x, dy = b.y - a.y, length = std::sqrt(dx * dx + dy * dy);
  if (length == 0) return std::sqrt((p.x - a.x) * (p.x - a.x) + (p.y - a.y) * (p.y - a.y));
  return std::fabs(dx * (p.y - a.y) - dy * (p.x - a.x)) / length;
}

/// Thins a polyline with the method of Ramer, Douglas and Peucker: keeps the point farthest from the straight
/// line between the ends, and repeats this on both sides of the point.
std::vector<Place> thinned_wave(const std::vector<Place>& points) {
  std::vector<bool> stays(points.size(), false);
  std::vector<std::pair<std::size_t, std::size_t>> open = {{0, points.size() - 1}};
  stays.front() = stays.back() = true;
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    std::size_t farthest = from;
    double most = within;
    for (std::size_t n = from + 1; n < to; ++n)
      if (const double d = distance(points[n], points[from], points[to]); d > most) {
        most = d;
        farthest = n;
      }
    if (farthest == from) continue;
    stays[farthest] = true;
    open.push_back({from, farthest});
    open.push_back({farthest, to});
  }
  std::vector<Place> out;
  for (std::size_t n = 0; n < points.size(); ++n)
    if (stays[n]) out.push_back(points[n]);
  return out;
}

std::vector<std::string> lines(std::string_view text, std::size_t width) {
  std::vector<std::string> out = {""};
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string word(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (!out.back().empty() && out.back().size() + 1 + word.size() > width) out.emplace_back();
    out.back() += (out.back().empty() ? "" : " ") + word;
  }
  return out;
}

}  // namespace

std::string line_through(const std::vector<Place>& points) {
  if (points.empty()) return "";
  std::string d;
  long x = 0, y = 0;
  for (const Place& p : thinned_wave(points)) {
    const long to_x = std::lround(10 * p.x), to_y = std::lround(10 * p.y);
    if (d.empty())
      d = fmt::format("M{} {}l", to_x, to_y);
    else if (to_x != x || to_y != y)
      d += fmt::format("{}{}{}{}", d.back() == 'l' || to_x < x ? "" : " ", to_x - x, to_y < y ? "" : " ",
                       to_y - y);
    x = to_x;
    y = to_y;
  }
  return d.back() == 'l' ? d + "0 0" : d;
}

std::string_view style_of(WiringDoes does) {
  switch (does) {
    case WiringDoes::forward:
      return "forward";
    case WiringDoes::backward:
      return "backward";
    case WiringDoes::forward_early:
    case WiringDoes::forward_late:
    case WiringDoes::backward_early:
    case WiringDoes::backward_late:
      return "rough";
    case WiringDoes::hums:
      return "hums";
    case WiringDoes::unclear:
      break;
  }
  return "unclear";
}

std::string mark_of(WiringDoes does, double x, double y) {
  const int way = sixstep::analysis::direction_of(does);
  if (way == 0)
    return fmt::format("<path class=\"w-wave {}\" d=\"M{:.1f} {:.1f}q1.5 -7 3 0t3 0 3 0 3 0\"/>\n",
                       style_of(does), x, y + 6);
  const double tail = way > 0 ? x + 1 : x + 11, head = way > 0 ? x + 11 : x + 1;
  return fmt::format("<path class=\"w-arrow {}\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}L{:.1f} {:.1f}z\"/>\n",
                     style_of(does), tail, y + 1, head, y + 6, tail, y + 11);
}

std::string wrapped(std::string_view text, std::size_t width, double x, double y, double leading,
                    std::string_view style) {
  std::string out;
  for (const std::string& line : lines(text, width)) {
    out += fmt::format("<text{} x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
                       style.empty() ? "" : fmt::format(" class=\"{}\"", style), x, y, escaped(line));
    y += leading;
  }
  return out;
}

std::size_t lines_of(std::string_view text, std::size_t width) { return lines(text, width).size(); }

std::string times_text(double ratio) { return fmt::format("×{:.{}f}", ratio, ratio < 9.95 ? 1 : 0); }

std::string_view wiring_style() {
  return R"(.wiring{font:12px system-ui,-apple-system,"Segoe UI",Roboto,"Noto Sans","DejaVu Sans",sans-serif;fill:var(--ink)}
.wiring .q{fill:var(--quiet)}.wiring .s{font-size:10.5px}.wiring .b{font-weight:650}.wiring .m{text-anchor:middle}.wiring .e{text-anchor:end}
.wiring path,.wiring line{fill:none;vector-effect:non-scaling-stroke}
.wiring .w-cell{fill:var(--paper);stroke:var(--line)}
.wiring .w-axis{stroke:var(--line)}.wiring .w-level{stroke:var(--quiet);stroke-dasharray:2 3}
.wiring .w-theory{stroke:none;fill:currentColor;fill-opacity:.3}
.wiring .w-seen{stroke:var(--ink);stroke-width:1.1;stroke-linejoin:round}
.wiring .w-run{stroke:currentColor;stroke-width:1.2;stroke-linejoin:round;stroke-opacity:.85}
.wiring .w-arrow{fill:currentColor}.wiring .w-wave{stroke:currentColor;stroke-width:1.6}
.wiring .w-wire{stroke:var(--ink);stroke-width:1.5}
.wiring .w-high{fill:currentColor;stroke:currentColor}.wiring .w-low{fill:var(--paper);stroke:currentColor}.wiring .w-on{fill:var(--paper)}
.wiring .w-float{stroke:currentColor;stroke-dasharray:2 3}.wiring .w-emf{stroke-width:1.6}
.wiring .w-bar{fill:currentColor}
.wiring .forward{color:var(--c)}.wiring .backward{color:var(--a)}.wiring .rough{color:var(--b)}.wiring .hums,.wiring .unclear{color:var(--quiet)}
)";
}

}  // namespace report
