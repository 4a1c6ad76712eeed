// SPDX-License-Identifier: Apache-2.0
// A chart that needs no script: what a design shows has a few hundred points and no zoom.
#pragma once
#include <string>
#include <vector>

namespace report {

/// Of the style sheet, for curves that belong together.
inline constexpr const char* curve_styles[] = {"a", "b", "c"};

struct SvgCurve {
  std::string label;
  std::string style;  ///< a colour of the style sheet: "a", "b", "c", "main", "reference" (dashed)
  std::vector<double> x{},
      y{};  ///< points that are not finite, or not positive on a logarithmic axis, break it
};

/// A point with a name beside it.
struct SvgMark {
  double x, y;
  std::string label;
  std::string style;  ///< as a curve's
};

struct SvgChart {
  std::string title, x_label, y_label{};
  bool log_x = false, log_y = false;
  double y_tick = 0.0;   ///< distance of the lines; 0: round numbers
  bool compact = false;  ///< half as large, for a place beside others
  std::vector<SvgCurve> curves{};
  std::vector<double> levels{};  ///< horizontal lines
  std::vector<SvgMark> marks{};
};

/// A <figure> with caption, legend and drawing; empty where neither a curve nor a mark has a point.
std::string svg_chart(const SvgChart& chart);

}  // namespace report
