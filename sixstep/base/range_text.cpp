// SPDX-License-Identifier: Apache-2.0
#include "sixstep/base/range_text.hpp"

#include <charconv>
#include <cmath>

#include "sixstep/base/plausible.hpp"
#include "sixstep/base/written.hpp"

namespace sixstep::base {
namespace {

bool finite(double x) { return x - x == 0.0; }

/// Writes 9000000, not 9e+06, because limits are easier to read without an exponent.
std::string plain(double x) {
  if (!(std::fabs(x) >= 1e-4 && std::fabs(x) < 1e10)) return written(x);
  char text[32];
  const std::to_chars_result end = std::to_chars(text, text + sizeof text, x, std::chars_format::fixed);
  return {text, end.ptr};
}

}  // namespace

std::string limit_of(const Range& range) {
  const bool low = finite(range.low), high = finite(range.high);
  if (!low && !high) return "must be a finite number";
  if (low && high && range.low_included && range.high_included)
    return "must lie in " + plain(range.low) + " to " + plain(range.high);
  if (low && high && !range.low_included && !range.high_included)
    return "must lie strictly between " + plain(range.low) + " and " + plain(range.high);
  std::string text = "must be";
  if (low) text += (range.low_included ? " at least " : " above ") + plain(range.low);
  if (high)
    text +=
        (low ? " and" : "") + std::string(range.high_included ? " at most " : " below ") + plain(range.high);
  return text;
}

std::string limit_of(const Range& own, const Range& allowed, double x) {
  if (!finite(x)) return "must be a finite number";
  if (!own.holds(x)) return limit_of(own);
  if (x == 0.0 || std::fabs(x) >= allowed.least) return limit_of(allowed);
  if (allowed.low == 0.0 && !allowed.low_included) return "must be at least " + plain(allowed.least);
  return "must be 0 or at least " + plain(allowed.least) + " in size";
}

Problems out_of_range(const char* where, double x, const Range& own, std::string_view unit,
                      const char* cure) {
  const Range range = allowed(own, unit);
  if (range.holds(x)) return {};
  return {{where, written(x), limit_of(own, range, x), cure}};
}

}  // namespace sixstep::base
