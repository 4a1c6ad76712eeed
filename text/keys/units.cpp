// SPDX-License-Identifier: Apache-2.0
#include "text/keys/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "text/keys/decimal_number.hpp"
#include "text/keys/key_advice.hpp"

namespace text {
namespace {

constexpr std::string_view usual[] = {
    "s",     "ms",    "us",   "min",    "V",     "mV",      "kV",   "A",    "mA",    "ohm",    "mohm",
    "H",     "mH",    "uH",   "F",      "mF",    "uF",      "Hz",   "kHz",  "MHz",   "rad/s",  "rpm",
    "deg/s", "rad",   "deg",  "Nm",     "mNm",   "Ncm",     "kgm2", "gcm2", "kgcm2", "Nms",    "mNm/rpm",
    "Nm/A",  "mNm/A", "Vs",   "V/krpm", "rpm/V", "rpm/mNm", "K/W",  "degC", "Wb",    "mWb",    "T",
    "mT",    "mm",    "cm",   "A/V",    "%",     "As/rad",  "A/s",  "A/ms", "rpm/s", "rad/s2", "deg/s2",
    "N",     "m/s",   "mm/s", "kg",     "N/A",   "kg/m3",
};

bool begins_a_number(std::string_view text) {
  const std::size_t at = text.find_first_not_of("+-");
  return at < 2 && (text[at] == '.' || (text[at] >= '0' && text[at] <= '9'));
}

/// The number times 10^ten, rounded once: the exponent moves, the digits stay.
std::optional<double> shifted(const std::string& number, int ten) {
  const std::size_t e = std::min(number.find_first_of("eE"), number.size());
  int exponent = 0;
  if (e < number.size()) {
    const char* digits = number.data() + e + (number[e + 1] == '+' ? 2 : 1);
    if (std::from_chars(digits, number.data() + number.size(), exponent).ec != std::errc()) return {};
  }
  const std::string text = fmt::format("{}e{}", number.substr(0, e), static_cast<long>(exponent) + ten);
  const DecimalNumber x = decimal_number(text);
  return x.kind == DecimalNumber::Kind::number ? std::optional(x.value) : std::nullopt;
}

std::string plain_number(std::string_view wanted) {
  return wanted.empty() ? "a plain number" : fmt::format("in {}", wanted);
}

/// Usual units of the same kind, the key's own first.
std::vector<std::string> fitting(std::string_view wanted) {
  const std::optional<Unit> unit = unit_of(wanted);
  std::vector<std::string> fit = {std::string(wanted)};
  for (const std::string_view candidate : usual)
    if (const auto u = unit_of(candidate);
        unit && u && u->dimension == unit->dimension && plain_spelling(wanted) != candidate)
      fit.emplace_back(candidate);
  return fit;
}

/// Of those that fit: "MS" was meant as ms, "rmp" as rpm.
std::string fitting_like(const std::string& unit, std::string_view wanted) {
  const auto small = [](std::string_view text) {
    std::string out(text);
    for (char& c : out) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return out;
  };
  const std::vector<std::string> fit = fitting(wanted);
  for (const std::string& word : fit)
    if (small(word) == small(unit)) return word;
  return nearest(unit, fit);
}

base::Problem wrong_unit(const Written& w, std::string_view wanted) {
  if (w.unit.starts_with(','))
    return {.limit = "has a decimal comma", .cure = "write the decimal point as a point"};
  const bool known = unit_of(w.unit).has_value();
  if (wanted.empty())
    return {.limit = fmt::format("carries the {} {}, and this key is a plain number",
                                 known ? "unit" : "unknown unit", w.unit),
            .cure = "write the number alone, or in %"};
  const std::string fit = units_that_fit(wanted);
  if (known)
    return {.limit = fmt::format("carries the unit {}, which is not of the kind of {}", w.unit, wanted),
            .cure = "units that fit: " + fit};
  const std::string near = fitting_like(w.unit, wanted);
  return {.limit = fmt::format("carries an unknown unit, {}", w.unit),
          .cure = near.empty() ? "units that fit: " + fit
                               : fmt::format("did you mean {}? Units that fit: {}", near, fit)};
}

}  // namespace

std::optional<Written> split_number(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  if (text.empty() || !begins_a_number(text)) return {};
  if (text.front() == '+') text.remove_prefix(1);
  const std::size_t size = decimal_number(text).size;
  if (size == 0) return {};
  std::string_view rest = text.substr(size);
  const std::string number(text.substr(0, size));
  while (!rest.empty() && rest.front() == ' ') rest.remove_prefix(1);
  return Written{number, std::string(rest)};
}

base::Result<double> in_unit(std::string_view written, std::string_view wanted) {
  const std::optional<Written> w = split_number(written);
  if (!w)
    return base::Problem{.limit = wanted.empty()
                                      ? "must be a number without quotes"
                                      : fmt::format("must be a number, {}, or one with its unit in "
                                                    "quotes",
                                                    plain_number(wanted))};
  if (w->unit.empty())
    return base::Problem{.limit = wanted.empty() ? "must be a number without quotes" : "lacks its unit",
                         .cure = wanted.empty() ? "write " + w->number
                                                : fmt::format("write {}, which is in {}, or \"{} {}\"",
                                                              w->number, wanted, w->number, wanted)};
  const std::optional<Unit> from = unit_of(w->unit), to = unit_of(wanted);
  if (!from || !to || !same_kind(*from, *to)) return wrong_unit(*w, wanted);
  const std::optional<double> x = shifted(w->number, from->ten - to->ten);
  if (!x) return base::Problem{.limit = "is beyond what a number holds", .cure = "look at its exponent"};
  return from->factor == to->factor ? *x : *x * from->factor / to->factor;
}

std::string units_that_fit(std::string_view wanted) {
  if (wanted.empty()) return {};
  const std::vector<std::string> fit = fitting(wanted);
  std::string text;
  for (std::size_t n = 0; n < fit.size(); ++n)
    text += (n == 0 ? "" : n + 1 == fit.size() ? " or " : ", ") + fit[n];
  return text;
}

}  // namespace text
