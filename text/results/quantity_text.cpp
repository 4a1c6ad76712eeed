// SPDX-License-Identifier: Apache-2.0
#include "text/results/quantity_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace text {
namespace {

constexpr int few_digits = 5, all_digits = 17;

struct Prefix {
  std::string_view letter;
  double times;  ///< factor on x: 1000 for milli
};
constexpr Prefix no_prefix{"", 1.0};

/// Whether a unit takes prefixes; rad/s, degrees and ratios do not.
bool takes_prefix(std::string_view unit) {
  constexpr std::array<std::string_view, 10> with = {"s", "A", "V", "Hz", "N m", "Nm", "W", "J", "ohm", "H"};
  return std::find(with.begin(), with.end(), unit) != with.end();
}

Prefix prefix_for(double x, std::string_view unit) {
  const double size = std::abs(x);
  if (!takes_prefix(unit) || !(size >= 1e-12) || !(size < 1e9)) return no_prefix;
  if (size >= 0.1 && size < 1e3) return no_prefix;  // 0.78 N m and 0.5 A stay without prefix
  constexpr std::array<Prefix, 7> prefixes = {
      {{"M", 1e-6}, {"k", 1e-3}, {"", 1.0}, {"m", 1e3}, {"u", 1e6}, {"n", 1e9}, {"p", 1e12}}};
  // A value slightly below 1 counts as 1, because 1e-9 * 1e9 need not be 1.
  for (const Prefix& prefix : prefixes)
    if (size * prefix.times >= 1.0 - 1e-12) return prefix;
  return no_prefix;
}

std::string prefixed(double x, Prefix prefix, int digits) {
  // Prints 800 with two digits as 800, not as 8e+02.
  const double value = x * prefix.times, size = std::fabs(value);
  if (size >= 100.0 && size < 1e6 && size >= std::pow(10.0, digits) - 0.5)
    return fmt::format("{:.0f}", value);
  const std::string text = fmt::format("{:.{}g}", value, digits);
  return text == "-0" ? "0" : text;
}

std::string unit_text(Prefix prefix, const std::string& unit) {
  return unit == "1" ? "" : std::string(prefix.letter) + unit;
}

std::string joined(const std::string& text, const std::string& unit) {
  return unit.empty() ? text : text + " " + unit;
}

/// Words for values that are not finite: "never" for a time whose event did not occur, "no value" for a
/// figure of an empty window.
std::string without_number(double x, const std::string& unit) {
  if (std::isnan(x)) return "no value";
  return unit == "s" && x > 0.0 ? "never"
                                : joined(prefixed(x, no_prefix, few_digits), unit_text(no_prefix, unit));
}

}  // namespace

std::string quantity_text(double x, const std::string& unit, int digits) {
  if (!std::isfinite(x)) return without_number(x, unit);
  const Prefix prefix = prefix_for(x, unit);
  return joined(prefixed(x, prefix, digits), unit_text(prefix, unit));
}

SharedPrefix::SharedPrefix(std::span<const double> values, const std::string& unit) : unit_(unit) {
  constexpr double most = 1e4, least = 0.1;
  double smallest = 0.0, largest = 0.0;
  for (const double x : values) {
    const double size = std::fabs(x);
    if (!std::isfinite(x) || size == 0.0) continue;
    smallest = smallest == 0.0 ? size : std::min(smallest, size);
    largest = std::max(largest, size);
  }
  if (largest == 0.0 || largest > most * smallest) return;
  const bool small_fits = largest * prefix_for(smallest, unit).times < most;
  like_ = small_fits && smallest * prefix_for(largest, unit).times < least ? smallest : largest;
}

std::string SharedPrefix::text(double x, int digits) const {
  if (!std::isfinite(x) || like_ == 0.0) return quantity_text(x, unit_, digits);
  const Prefix prefix = prefix_for(like_, unit_);
  return joined(prefixed(x, prefix, digits), unit_text(prefix, unit_));
}

std::string counted(std::size_t n, const char* what) {
  return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

std::string fixed_text(double x, int digits) {
  return std::isfinite(x) ? fmt::format("{:.{}f}", x, digits) : "-";
}

std::string csv_cell(double x) {
  if (std::isnan(x)) return "";
  return std::isinf(x) ? (x > 0.0 ? "never" : "-never") : fmt::format("{}", x);
}

ComparedTexts compared_texts(double x, std::span<const double> yardsticks, const std::string& unit) {
  double largest = 0.0;
  for (const double y : yardsticks) largest = std::max(largest, std::abs(y));
  // If all yardsticks are zero, the prefix of x is used.
  Prefix shared = prefix_for(largest > 0.0 ? largest : x, unit);
  if (largest == 0.0 && x == 0.0) shared = no_prefix;
  const double ratio = std::abs(largest > 0.0 ? x / largest : 1.0);
  const bool alike = x == 0.0 || (ratio >= 1e-3 && ratio < 1e3);
  const Prefix own = alike ? shared : prefix_for(x, unit);

  ComparedTexts texts;
  for (int digits = few_digits; digits <= all_digits; ++digits) {
    // If x is less than a thousandth of all yardsticks, only its magnitude matters, and x has a separate
    // prefix.
    const bool tiny = !alike && ratio < 1e-3;
    const std::string x_text = prefixed(x, own, tiny ? 2 : digits);
    texts = {{}, joined(x_text, unit_text(own, unit)), unit_text(shared, unit)};
    bool told_apart = true;
    for (const double y : yardsticks) {
      const std::string text = prefixed(y, shared, digits);
      told_apart = told_apart && (y == x || !alike || text != x_text);
      for (std::size_t n = 0; n < texts.yardsticks.size(); ++n)
        told_apart = told_apart && (y == yardsticks[n] || text != texts.yardsticks[n]);
      texts.yardsticks.push_back(text);
    }
    if (!std::isfinite(x)) texts.x = without_number(x, unit);
    if (told_apart) return texts;
  }
  // Multiplication by the prefix may round away the last bit, in which the numbers differ. Without prefix the
  // difference is visible.
  return {[&] {
            std::vector<std::string> plain;
            for (const double y : yardsticks) plain.push_back(prefixed(y, no_prefix, all_digits));
            return plain;
          }(),
          joined(prefixed(x, no_prefix, all_digits), unit_text(no_prefix, unit)), unit_text(no_prefix, unit)};
}

}  // namespace text
