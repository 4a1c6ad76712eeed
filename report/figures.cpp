// SPDX-License-Identifier: Apache-2.0
#include "report/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace report {
namespace {

struct Prefix {
  double factor;
  std::string_view name;
};
constexpr std::array<Prefix, 8> prefixes{
    {{1e12, "p"}, {1e9, "n"}, {1e6, "µ"}, {1e3, "m"}, {1, ""}, {1e-3, "k"}, {1e-6, "M"}, {1e-9, "G"}}};

/// The text of a unit in column names, the printed text of the same unit, and whether it usually has a
/// prefix.
struct UnitForm {
  std::string_view written, printed;
  bool prefixed;
};
constexpr std::array<UnitForm, 19> unit_forms{{{"N m", "Nm", true},
                                               {"s", "s", true},
                                               {"A", "A", true},
                                               {"V", "V", true},
                                               {"W", "W", true},
                                               {"J", "J", true},
                                               {"Nm", "Nm", true},
                                               {"H", "H", true},
                                               {"F", "F", true},
                                               {"Hz", "Hz", true},
                                               {"Wb", "Wb", true},
                                               {"ohm", "Ω", false},
                                               {"Nm/A", "Nm/A", true},
                                               {"V s", "V s", true},
                                               {"deg", "°", false},
                                               {"kg m2", "kg m²", false},
                                               {"kg_m2", "kg m²", false},
                                               {"Nm s", "Nm s", false},
                                               {"1", "", false}}};

UnitForm form_of(std::string_view unit) {
  for (const UnitForm& form : unit_forms)
    if (form.written == unit) return form;
  return {unit, unit, false};
}

int decade(double value) {
  return value == 0.0 ? 0 : static_cast<int>(std::floor(std::log10(std::abs(value))));
}

std::string with_unit(std::string number, const std::string& unit) {
  if (unit.empty()) return number;
  // The degree sign directly follows the number; other units follow a non-breaking space.
  return number + (unit == "°" ? "" : "\u00a0") + unit;
}

std::string superscript(int exponent) {
  static constexpr std::array<std::string_view, 10> digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out = exponent < 0 ? "⁻" : "";
  for (const char c : std::to_string(std::abs(exponent))) out += digits[static_cast<std::size_t>(c - '0')];
  return out;
}

std::string fixed(double value, int decimals, bool trim) {
  std::string text = fmt::format("{:.{}f}", std::abs(value), std::clamp(decimals, 0, 15));
  if (trim && text.find('.') != text.npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  const bool zero = text.find_first_not_of("0.") == text.npos;
  return (value < 0.0 && !zero ? "−" : "") + text;
}

}  // namespace

Scale scale_for(double magnitude, std::string_view unit) {
  const UnitForm form = form_of(unit);
  Scale best{1.0, std::string(form.printed)};
  if (!form.prefixed || magnitude == 0.0 || !std::isfinite(magnitude)) return best;
  for (const Prefix& p : prefixes) {
    best = {p.factor, fmt::format("{}{}", p.name, form.printed)};
    if (std::abs(magnitude) * p.factor < 999.95) break;
  }
  return best;
}

std::string plain(double value, int digits, bool trim) {
  if (std::isnan(value)) return "–";
  if (std::isinf(value)) return value > 0 ? "∞" : "−∞";
  int power = decade(value);
  if (std::abs(value) >= std::pow(10.0, power + 1) - 0.5 * std::pow(10.0, power + 1 - digits))
    ++power;  // rounding changes the decade, as for 9.9999
  if (value != 0.0 && (power < -4 || power > 7)) {
    return fixed(value / std::pow(10.0, power), digits - 1, true) + "·10" + superscript(power);
  }
  return fixed(value, digits - 1 - power, trim);
}

std::string given(double value, std::string_view unit) {
  const Scale scale = scale_for(value, unit);
  return with_unit(plain(value * scale.factor, 7, true), scale.unit);
}

bool never(double value, std::string_view unit) { return std::isinf(value) && unit == "s"; }

std::string computed(double value, std::string_view unit) {
  if (never(value, unit)) return "never";
  const Scale scale = scale_for(value, unit);
  return with_unit(plain(value * scale.factor, 4), scale.unit);
}

std::vector<std::string> computed_alike(const std::vector<std::optional<double>>& values,
                                        std::string_view unit) {
  constexpr double most = 1e4, least = 0.1;
  double smallest = 0.0, largest = 0.0;
  for (const std::optional<double>& x : values) {
    if (!x || !std::isfinite(*x) || *x == 0.0) continue;
    smallest = smallest == 0.0 ? std::abs(*x) : std::min(smallest, std::abs(*x));
    largest = std::max(largest, std::abs(*x));
  }
  const Scale small = scale_for(smallest, unit), large = scale_for(largest, unit);
  const bool small_fits = largest * small.factor < most;
  const Scale shared = small_fits && smallest * large.factor < least ? small : large;
  const bool apart = largest == 0.0 || largest > most * smallest;
  std::vector<std::string> texts;
  texts.reserve(values.size());
  for (const std::optional<double>& x : values)
    texts.push_back(!x                            ? ""
                    : apart || !std::isfinite(*x) ? computed(*x, unit)
                                                  : with_unit(plain(*x * shared.factor, 4), shared.unit));
  return texts;
}

std::string_view difference_unit(std::string_view unit) { return unit == "degC" ? "K" : unit; }

std::string deviation(double measured, double reference, std::string_view unit) {
  const double difference = measured - reference;
  if (!std::isfinite(difference)) return "not comparable";
  // A ratio of numbers with opposite signs has no meaning, so the difference itself is printed.
  constexpr double most_times = 1000.0, most_percent = 1000.0;
  if (reference == 0.0 || (measured < 0.0) != (reference < 0.0) || unit == "degC" ||
      std::abs(measured) > most_times * std::abs(reference))
    return fmt::format("{}{}", difference > 0.0 ? "+" : "", computed(difference, difference_unit(unit)));
  const double percent = 100.0 * difference / reference;
  if (percent >= most_percent) return "×\u00a0" + plain(measured / reference, 3, true);
  const double size = std::abs(percent);
  const int decimals = size >= 100 ? 0 : size >= 10 ? 1 : size >= 0.095 ? 2 : 4;
  return fmt::format("{}{}\u00a0%", percent > 0.0 ? "+" : "", fixed(percent, decimals, false));
}

std::string in_percent(double part) { return plain(100.0 * part, 2, true) + "\u00a0%"; }

Judged judged(double measured, std::optional<double> min, std::optional<double> max, std::string_view unit) {
  const double limit = max && *max != 0.0 ? *max : min && *min != 0.0 ? *min : measured;
  const Scale scale = scale_for(limit, unit);
  // More digits are needed if two limits are close together, or if a measured value is close to its limit.
  double resolution = std::abs(limit) * 1e-3;
  const auto finer = [&](double gap) {
    if (gap > 0.0 && std::isfinite(gap)) resolution = std::min(resolution, gap * 0.1);
  };
  if (min && max) finer(*max - *min);
  if (max) finer(std::abs(*max - measured));
  if (min) finer(std::abs(measured - *min));
  const auto digits = [&](double value) {
    if (value == 0.0 || resolution == 0.0) return 4;
    return std::clamp(decade(value) - decade(resolution) + 1, 3, 12);
  };
  const auto show = [&](double value, bool trim) { return plain(value * scale.factor, digits(value), trim); };
  Judged out;
  out.measured = never(measured, unit) ? "never" : with_unit(show(measured, false), scale.unit);
  if (min && max)
    out.required = with_unit(show(*min, true) + " … " + show(*max, true), scale.unit);
  else if (max)
    out.required = "≤\u00a0" + with_unit(show(*max, true), scale.unit);
  else if (min)
    out.required = "≥\u00a0" + with_unit(show(*min, true), scale.unit);
  return out;
}

std::string aside(double value, std::string_view unit) {
  if (unit != "rad/s" || !std::isfinite(value)) return "";
  return plain(value * 30.0 / 3.14159265358979323846, 5, true) + "\u00a0rpm";
}

std::string grouped(long long count) {
  std::string digits = std::to_string(count);
  for (int at = static_cast<int>(digits.size()) - 3; at > (count < 0 ? 1 : 0); at -= 3)
    digits.insert(static_cast<std::size_t>(at), "\u202f");
  return digits;
}

}  // namespace report
