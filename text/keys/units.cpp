// SPDX-License-Identifier: Apache-2.0
#include "text/keys/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "sixstep/base/decimal.hpp"
#include "text/keys/decimal_number.hpp"
#include "text/keys/key_advice.hpp"

namespace text {
namespace {

constexpr std::string_view usual[] = {
    "s",     "ms",        "us",     "min",    "V",       "mV",         "kV",        "A",     "mA",
    "ohm",   "mohm",      "H",      "mH",     "uH",      "F",          "mF",        "uF",    "Hz",
    "kHz",   "MHz",       "rad/s",  "rpm",    "rev/s",   "deg/s",      "rad",       "deg",   "rev",
    "Nm",    "mNm",       "Ncm",    "oz-in",  "lb-in",   "lb-ft",      "kgf cm",    "kgm2",  "gcm2",
    "kgcm2", "oz-in-s2",  "lb-in2", "Nms",    "mNm/rpm", "Nm/(rad/s)", "Nm/A",      "mNm/A", "oz-in/A",
    "Vs",    "V/(rad/s)", "V/krpm", "mV/rpm", "rpm/V",   "rpm/mNm",    "rpm/oz-in", "K/W",   "degC/W",
    "degC",  "Wb",        "mWb",    "mV/Hz",  "T",       "mT",         "mm",        "cm",    "A/V",
    "%",     "As/rad",    "A/s",    "A/ms",   "rpm/s",   "rad/s2",     "deg/s2",    "N",     "m/s",
    "mm/s",  "kg",        "N/A",    "kg/m3",  "J",       "mJ",         "%/K",
};

bool begins_a_number(std::string_view text) {
  const std::size_t at = text.find_first_not_of("+-");
  return at < 2 && (text[at] == '.' || (text[at] >= '0' && text[at] <= '9'));
}

/// The number times 10^ten, rounded once, because only the exponent of its text changes.
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

bool takes_kind(Unit from, const Unit& to, const Unit& by) {
  for (std::size_t n = 0; n < from.dimension.size(); ++n) from.dimension[n] += by.dimension[n];
  return same_kind(from, to);
}

/// 1 if `from` has a mass times a length in place of a torque ("oz-in"), -1 if it has the inverse
/// ("rpm/kg-cm"), else 0.
int weights_in(const Unit& from, const Unit& to) {
  for (const int sign : {1, -1})
    if (from.power(Base::kg) == sign && from.power(Base::m) == sign &&
        takes_kind(from, to, {.dimension = {0, sign, -2 * sign}}))
      return sign;
  return 0;
}

/// The power of standard_gravity in the conversion between the two units.
int gravity_between(const Unit& from, const Unit& to) {
  const int power = weights_in(from, to);
  return power != 0 ? power : -weights_in(to, from);
}

/// The power of the electrical angle that must be converted to the mechanical angle; 0 if this conversion
/// does not result in the wanted kind of unit.
int electrical_in(const Unit& from, const Unit& to) {
  const int power = from.power(Base::electrical_rad);
  const bool fits = to.power(Base::electrical_rad) == 0 &&
                    takes_kind(from, to, {.dimension = {0, 0, 0, 0, 0, 0, power, 0, -power}});
  return fits ? power : 0;
}

/// Usual units of the wanted kind, the key's own unit first.
std::vector<std::string> fitting(std::string_view wanted) {
  static const std::vector<Unit> read = [] {
    std::vector<Unit> units;
    for (const std::string_view candidate : usual) units.push_back(unit_of(candidate).value_or(Unit{}));
    return units;
  }();
  const std::optional<Unit> unit = unit_of(wanted);
  std::vector<std::string> fit = {std::string(wanted)};
  for (std::size_t n = 0; n < read.size(); ++n)
    if (unit && plain_spelling(wanted) != usual[n] &&
        (same_kind(read[n], *unit) || gravity_between(read[n], *unit) != 0))
      fit.emplace_back(usual[n]);
  return fit;
}

/// A usual unit of the wanted kind that resembles the written one: ms for "MS", rpm for "rmp".
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

base::Problem not_known(const std::string& unit, const std::string& wanted) {
  if (unit.starts_with(','))
    return {.limit = "has a decimal comma", .cure = "write a point, not a comma, as the decimal mark"};
  if (plain_spelling(unit) == "degF")
    return {.limit = "is in degrees Fahrenheit", .cure = "write (F - 32) / 1.8, in " + wanted};
  const std::string near = fitting_like(unit, wanted), fit = units_that_fit(wanted);
  return {.limit = fmt::format("has the unknown unit {}", unit),
          .cure = near.empty() ? "units that fit: " + fit
                               : fmt::format("did you mean {}? Units that fit: {}", near, fit)};
}

base::Problem no_plain_number(const std::string& unit, bool known) {
  return {.limit = fmt::format("has the {} {}, and this key takes a number without a unit",
                               known ? "unit" : "unknown unit", unit),
          .cure = "write the number without a unit, or with %"};
}

/// Whether the units are of one kind except for angles, and `from` contains minutes or hours.
bool multiplies_minutes(Unit from, Unit to) {
  for (Unit* unit : {&from, &to}) unit->power(Base::rad) = unit->power(Base::electrical_rad) = 0;
  return from.by_the_clock && from.dimension == to.dimension && to.dimension != Unit{}.dimension;
}

base::Problem other_kind(const std::string& unit, const Unit& from, const Unit& to, const Wanted& wanted) {
  const std::string fit = units_that_fit(wanted.unit);
  if (wanted.unit == "s" && plain_spelling(unit).ends_with("Hz"))
    return {.limit = fmt::format("has the unit {}, and this key is a time", unit),
            .cure = "write the period, 1 over the frequency: 20 kHz is 50 us. Units that fit: " + fit};
  return {
      .limit = fmt::format("has the unit {}, which cannot be converted to {}", unit, wanted.unit),
      .cure =
          multiplies_minutes(from, to)
              ? "this unit contains minutes as a factor; write a value per rpm with /rpm or /min-1. Units that fit: " +
                    fit
              : "units that fit: " + fit};
}

base::Problem other_measure(const std::string& unit, std::string_view measure, const Wanted& wanted) {
  std::string frames;
  for (const std::string& frame : frames_with(wanted.frames, "")) frames += " \"" + frame + "\"";
  return {
      .limit = fmt::format("has the unit {}, and this key takes no {} value", unit, measure),
      .cure =
          frames.empty()
              ? fmt::format("write the value in {}; the peak of a sine is sqrt 2 times its rms value",
                            wanted.unit)
              : fmt::format(
                    "convert the value to one of the frames{}; the peak of a sine is sqrt 2 times its rms value",
                    frames)};
}

double to_power(double x, int power) {
  double out = 1.0;
  for (int n = 0; n < power; ++n) out *= x;
  return out;
}

/// Converts by the pole pairs. Hertz of a voltage are electrical by convention. Hertz of a shaft are refused
/// as ambiguous: turns per second, or turns times pole pairs.
base::Result<Conversion> by_pole_pairs(const std::string& unit, int power, const Unit& to,
                                       const Wanted& wanted, Conversion conversion) {
  if (to.power(Base::V) == 0 && plain_spelling(unit).find("Hz") != std::string::npos)
    return base::Problem{
        .limit = fmt::format("has the unit {}, which may count turns of the shaft or electrical turns", unit),
        .cure = fmt::format(
            "write rev/s for turns of the shaft, or erpm, 60 times the electrical hertz; units that fit: {}",
            units_that_fit(wanted.unit))};
  if (!wanted.pole_pairs)
    return base::Problem{
        .limit = fmt::format(
            "has the unit {}, which counts electrical turns, and the pole pairs are not given", unit),
        .cure = "also give pole_pairs, poles or winding, or convert the value; units that fit: " +
                units_that_fit(wanted.unit)};
  const double p = *wanted.pole_pairs;
  conversion.multiply *= to_power(p, -power);
  conversion.divide *= to_power(p, power);
  return conversion;
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

double Conversion::of(double x) const {
  const double scaled = base::times_ten_to(x, ten);
  return multiply == divide ? scaled : scaled * multiply / divide;
}

double Conversion::back(double x) const { return Conversion{-ten, divide, multiply}.of(x); }

std::string_view measure_in(std::string_view text) {
  const std::optional<Unit> unit = unit_of(text);
  if (!unit) return {};
  return unit->power(Base::rms) != 0 ? "rms" : unit->power(Base::peak) != 0 ? "peak" : "";
}

std::vector<std::string> frames_with(std::string_view frames, std::string_view measure) {
  std::vector<std::string> fit;
  while (!frames.empty()) {
    const std::size_t cut = std::min(frames.find('|'), frames.size());
    if (frames.substr(0, cut).ends_with(measure)) fit.emplace_back(frames.substr(0, cut));
    frames.remove_prefix(std::min(cut + 1, frames.size()));
  }
  return fit;
}

base::Result<Conversion> conversion(std::string_view unit, const Wanted& wanted) {
  const std::string written(unit);
  std::optional<Unit> from = unit_of(unit);
  const std::optional<Unit> to = unit_of(wanted.unit);
  if (wanted.unit.empty() && (!from || from->dimension != Dimension{}))
    return no_plain_number(written, from.has_value());
  if (!from || !to) return not_known(written, wanted.unit);
  const std::string_view measure = measure_in(unit);
  from->power(Base::rms) = from->power(Base::peak) = 0;
  const bool same = same_kind(*from, *to);
  const int electrical = same ? 0 : electrical_in(*from, *to),
            gravity = same ? 0 : gravity_between(*from, *to);
  if (!same && electrical == 0 && gravity == 0) return other_kind(written, *from, *to, wanted);
  if (!measure.empty() && frames_with(wanted.frames, measure).empty())
    return other_measure(written, measure, wanted);
  Conversion conversion{from->ten - to->ten, from->factor, to->factor};
  if (electrical != 0) return by_pole_pairs(written, electrical, *to, wanted, conversion);
  if (gravity != 0) (gravity > 0 ? conversion.multiply : conversion.divide) *= standard_gravity;
  return conversion;
}

base::Result<double> in_unit(std::string_view text, const Wanted& wanted) {
  const std::optional<Written> w = split_number(text);
  if (!w)
    return base::Problem{.limit = wanted.unit.empty()
                                      ? "must be a number without quotes"
                                      : fmt::format("must be a number, {}, or a number with its unit in "
                                                    "quotes",
                                                    plain_number(wanted.unit))};
  if (w->unit.empty())
    return base::Problem{.limit = wanted.unit.empty() ? "must be a number without quotes" : "lacks its unit",
                         .cure = wanted.unit.empty()
                                     ? "write " + w->number
                                     : fmt::format("write {}, which is in {}, or \"{} {}\"", w->number,
                                                   wanted.unit, w->number, wanted.unit)};
  const base::Result<Conversion> by = conversion(w->unit, wanted);
  if (!by) return by.problems();
  const std::optional<double> x = shifted(w->number, by->ten);
  if (!x)
    return base::Problem{.limit = "is outside the range of a double, 4.9e-324 to 1.8e308",
                         .cure = "correct its exponent"};
  return by->multiply == by->divide ? *x : *x * by->multiply / by->divide;
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
