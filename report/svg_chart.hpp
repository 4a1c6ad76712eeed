// SPDX-License-Identifier: Apache-2.0
// Draws a chart without a script: a design's charts have a few hundred points and no zoom.
#pragma once
#include <string>
#include <vector>

namespace report {

/// Names in the style sheet for the curves of a group.
inline constexpr const char* curve_styles[] = {"a", "b", "c"};

struct SvgCurve {
  std::string label;
  std::string style;  ///< name in the style sheet: "a", "b", "c", "main", "reference" (dashed)
  std::vector<double> x{},
      y{};  ///< a point that is not finite, or not positive on a logarithmic axis, interrupts the curve
};

/// A point with a label.
struct SvgMark {
  double x, y;
  std::string label;
  std::string style;  ///< name in the style sheet, as for curves
};

struct SvgChart {
  std::string title, x_label, y_label{};
  bool log_x = false, log_y = false;
  double y_tick = 0.0;   ///< distance of the grid lines; 0: round numbers
  bool compact = false;  ///< true: half the usual size, for charts side by side
  std::vector<SvgCurve> curves{};
  std::vector<double> levels{};  ///< values at which horizontal lines are drawn
  std::vector<SvgMark> marks{};
};

/// A <figure> with caption, legend and drawing; empty if no curve and no mark has a point.
std::string svg_chart(const SvgChart& chart);

}  // namespace report
