// SPDX-License-Identifier: Apache-2.0
// Units as people write them, "20 ms" or "135 gcm2", and their values in the unit that a key carries.
#pragma once
#include <array>
#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/base/result.hpp"
#include "text/rooms.hpp"

namespace text {

/// What units are products of. The volt stands beside the kilogram, so that a torque per ampere is no voltage per speed,
/// which have different frames. The Celsius scale is no multiple of K. An angle of the shaft and an electrical one are two
/// things with the pole pairs between them: hertz and erpm count electrical turns. Rms and peak are part of the unit too.
enum class Base : std::uint8_t { kg, m, s, A, V, K, rad, degC, electrical_rad, rms, peak };
using Dimension = std::array<int, 11>;

/// m/s2: by definition what a pound-force and a kilogram-force are made of.
inline constexpr double standard_gravity = 9.80665;

/// A value in this unit is `factor` times 10^ten of the one in SI. Decimal powers stand apart, for they cost no rounding.
struct Unit {
  Dimension dimension{};
  int ten = 0;
  double factor = 1.0;
  bool by_the_clock = false;  ///< minutes or hours are in it, other than those of rpm

  int power(Base base) const { return dimension[static_cast<std::size_t>(base)]; }
  int& power(Base base) { return dimension[static_cast<std::size_t>(base)]; }
};

/// "mNm/A", "kg m2", "oz-in", "Nm/(rad/s)", "mV/min-1", "%"; empty for what is no unit, the plain number 1 for "".
std::optional<Unit> unit_of(std::string_view text);

/// The same as the table spells it: without the signs that few keyboards have, products by spaces, rpm for all its names.
std::string plain_spelling(std::string_view unit);

/// Whether values convert by ten and factor alone. An angle counts: 1/s is no speed, hertz are none, and N m/rad is no N m.
/// It may be left out where a speed has been written as 1/s by habit: V s for V/(rad/s), N m s for N m/(rad/s).
bool same_kind(const Unit& a, const Unit& b);

/// What a number is wanted in.
struct Wanted {
  std::string unit;
  std::string frames;             ///< those of the key, '|' between: where one is of rms, the unit may say so
  std::optional<int> pole_pairs;  ///< where they are known, electrical turns convert

  template <std::convertible_to<std::string_view> Text>
  Wanted(const Text& unit_text, std::string_view frames_text = {}, std::optional<int> pairs = {})
      : unit(std::string_view(unit_text)), frames(frames_text), pole_pairs(pairs) {}
};

/// A number in the one unit is 10^ten * multiply / divide times as large in the other.
struct Conversion {
  int ten = 0;
  double multiply = 1.0, divide = 1.0;
  double of(double x) const;
  double back(double x) const;  ///< the other way
};

/// From `unit` into what is wanted; the Problem has limit and cure. What same_kind() leaves open is settled here: a weight
/// stands for its force in oz-in and kg cm, hertz in V/Hz are electrical.
base::Result<Conversion> conversion(std::string_view unit, const Wanted& wanted);

/// "rms" or "peak" where the unit says which amperes or volts it means; else empty.
std::string_view measure_in(std::string_view unit);

/// Those of a key's frames, '|' between, that a measure leaves: "line-rms" and "phase-rms" of "rms".
std::vector<std::string> frames_with(std::string_view frames, std::string_view measure);

/// A number with a unit behind it; empty where it begins with none.
struct Written {
  std::string number, unit;
};
std::optional<Written> split_number(std::string_view text);

/// The value of `written` in the unit `wanted`, with the Problem's limit and cure where there is none. Where
/// the units differ by a power of ten, it is the double nearest to the decimal: "0.572 mH" is 0.000572 as if
/// it were written so. Else, as for rpm in rad/s, a few roundings more.
base::Result<double> in_unit(std::string_view written, const Wanted& wanted);

/// Usual units of the same kind, the key's own first: "s, ms, us or min".
std::string units_that_fit(std::string_view wanted);

}  // namespace text
