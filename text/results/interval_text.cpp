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
  return std::max(1 - static_cast<int>(std::floor(std::log10(width))), 0);
}

/// Writes x with the decimals that give the interval's half width two significant digits; uses a power of ten if both bounds are below 1e-3 in magnitude.
std::string digits_text(double x, const analysis::Interval& bounds) {
  const int decimals = decimals_of(bounds);
  if (x != 0.0 && std::max(std::fabs(bounds.low), std::fabs(bounds.high)) < 1e-3) {
    const int digits = decimals + static_cast<int>(std::floor(std::log10(std::fabs(x))));
    return fmt::format("{:.{}e}", x, std::clamp(digits, 0, 15));
  }
  std::string text = fmt::format("{:.{}f}", x, std::min(decimals, 9));
  if (text[0] == '-' && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
  return text;
}

}  // namespace

std::string measured_text(const analysis::Interval& x) { return digits_text(x.value, x); }

std::string bounds_text(const analysis::Interval& x) {
  return digits_text(x.low, x) + " .. " + digits_text(x.high, x);
}

std::string with_bounds(const analysis::Interval& x, const char* unit) {
  return fmt::format("{} {} ({})", measured_text(x), unit, bounds_text(x));
}

std::string as_good_as(double value, const analysis::Interval& x) { return digits_text(value, x); }

std::string certainty_text(double probability) {
  return probability > 0.9999 ? "> 99.99 %" : fmt::format("{:.4g} %", 100.0 * probability);
}

}  // namespace text
