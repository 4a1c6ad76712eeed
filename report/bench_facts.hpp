// SPDX-License-Identifier: Apache-2.0
// What the pages of a bench's measurements have in common.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "report/svg_chart.hpp"

namespace report {

/// A name and what was found, of a list of facts.
std::string bench_fact(std::string_view name, const std::string& value);

/// A bar from 0 up, or from one value to another: a piece of a curve that breaks behind it.
inline void add_bar(SvgCurve& curve, double x, double from, double to) {
  curve.x.insert(curve.x.end(), {x, x, NAN});
  curve.y.insert(curve.y.end(), {from, to, NAN});
}

/// So many points of a long curve that a screen shows no difference.
inline std::size_t thinned_stride(std::size_t points) {
  constexpr std::size_t enough = 1500;
  return std::max<std::size_t>(1, points / enough);
}

}  // namespace report
