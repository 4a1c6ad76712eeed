// SPDX-License-Identifier: Apache-2.0
// Draws elements that several pages of bench measurements use.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "report/svg_chart.hpp"

namespace report {

/// One entry of a list of facts: a name and its value.
std::string bench_fact(std::string_view name, const std::string& value);

/// Appends a vertical bar at x, from `from` to `to`, as a separate piece of the curve.
inline void add_bar(SvgCurve& curve, double x, double from, double to) {
  curve.x.insert(curve.x.end(), {x, x, NAN});
  curve.y.insert(curve.y.end(), {from, to, NAN});
}

/// The stride that reduces a long curve to the number of points that a screen can show.
inline std::size_t thinned_stride(std::size_t points) {
  constexpr std::size_t enough = 1500;
  return std::max<std::size_t>(1, points / enough);
}

}  // namespace report
