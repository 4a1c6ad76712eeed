// SPDX-License-Identifier: Apache-2.0
#include "text/results/interval_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace text {
namespace {

int decimals_of(const analysis::Interval& x) {
  const double width = x.half_width();
  if (!(width > 0.0) || !std::isfinite(width)) return 6;
  return std::clamp(1 - static_cast<int>(std::floor(std::log10(width))), 0, 9);
}

std::string decimals_text(double x, int decimals) {
  std::string text = fmt::format("{:.{}f}", x, decimals);
  if (text[0] == '-' && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
  return text;
}

}  // namespace

std::string measured_text(const analysis::Interval& x) { return decimals_text(x.value, decimals_of(x)); }

std::string bounds_text(const analysis::Interval& x) {
  const int decimals = decimals_of(x);
  return decimals_text(x.low, decimals) + " .. " + decimals_text(x.high, decimals);
}

std::string with_bounds(const analysis::Interval& x, const char* unit) {
  return fmt::format("{} {} ({})", measured_text(x), unit, bounds_text(x));
}

std::string as_good_as(double value, const analysis::Interval& x) {
  return decimals_text(value, decimals_of(x));
}

std::string certainty_text(double probability) {
  return probability > 0.9999 ? "> 99.99 %" : fmt::format("{:.4g} %", 100.0 * probability);
}

}  // namespace text
