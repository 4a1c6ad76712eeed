// SPDX-License-Identifier: Apache-2.0
// Reads numbers with units, "20 ms" or "135 gcm2", and converts them to the unit of a key.
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

/// Base units; a unit is a product of their powers.
/// - The volt is a base in addition to the kilogram, so that a torque per ampere differs from a voltage per
///   speed: their frames differ.
/// - The Celsius scale is no multiple of K.
/// - Mechanical and electrical angles differ by the pole pairs: hertz and erpm count electrical turns.
/// - Rms and peak are part of the unit.
enum class Base : std::uint8_t { kg, m, s, A, V, K, rad, degC, electrical_rad, rms, peak };
using Dimension = std::array<int, 11>;

/// Standard gravity in m/s2, which defines the pound-force and the kilogram-force.
inline constexpr double standard_gravity = 9.80665;

/// A value x in this unit is x * `factor` * 10^ten in SI. The power of ten is a separate member, because
/// conversion() applies it to the decimal text without a rounding error.
struct Unit {
  Dimension dimension{};
  int ten = 0;
  double factor = 1.0;
  bool by_the_clock = false;  ///< true: contains minutes or hours, apart from the minute of rpm

  int power(Base base) const { return dimension[static_cast<std::size_t>(base)]; }
  int& power(Base base) { return dimension[static_cast<std::size_t>(base)]; }
};

/// The unit of a text such as "mNm/A", "kg m2", "oz-in", "Nm/(rad/s)", "mV/min-1", "%". The text "" means the
/// unit of a pure number. Empty if the text is no unit.
std::optional<Unit> unit_of(std::string_view text);

/// The unit in the table's spelling: without symbols that few keyboards have, with spaces in products, and
/// always "rpm".
std::string plain_spelling(std::string_view unit);

/// Whether a power of ten and a factor convert values from one unit to the other. Angles are part of the
/// kind: 1/s is no speed, hertz are no speed, N m/rad is not N m. Two units without their angle are accepted,
/// because sheets usually write a speed as 1/s: V s for V/(rad/s), and N m s for N m/(rad/s).
bool same_kind(const Unit& a, const Unit& b);

/// The unit into which a number is converted.
struct Wanted {
  std::string unit;
  std::string frames;             ///< the key's frames, separated by '|'; if one is rms, the unit may say rms
  std::optional<int> pole_pairs;  ///< empty: electrical turns cannot be converted

  template <std::convertible_to<std::string_view> Text>
  Wanted(const Text& unit_text, std::string_view frames_text = {}, std::optional<int> pairs = {})
      : unit(std::string_view(unit_text)), frames(frames_text), pole_pairs(pairs) {}
};

/// Converts a number x to x * 10^ten * multiply / divide.
struct Conversion {
  int ten = 0;
  double multiply = 1.0, divide = 1.0;
  double of(double x) const;
  double back(double x) const;  ///< the inverse conversion
};

/// Converts from `unit` into the wanted unit. The Problem has limit and cure. Unlike same_kind(), it accepts
/// oz-in and kg cm as torques, in which a weight means its force. It treats the hertz of V/Hz as electrical.
base::Result<Conversion> conversion(std::string_view unit, const Wanted& wanted);

/// "rms" or "peak" if the unit says so; else empty.
std::string_view measure_in(std::string_view unit);

/// The frames, separated by '|', that fit a measure: "line-rms" and "phase-rms" for "rms".
std::vector<std::string> frames_with(std::string_view frames, std::string_view measure);

/// A number and the unit after it. A text that does not begin with a number gives no result.
struct Written {
  std::string number, unit;
};
std::optional<Written> split_number(std::string_view text);

/// The value of `written` in the unit `wanted`; the Problem has limit and cure. If the units differ only by a
/// power of ten, the result is the double nearest to the decimal: "0.572 mH" gives exactly 0.000572.
/// Otherwise the result is rounded a few times, as for rpm in rad/s.
base::Result<double> in_unit(std::string_view written, const Wanted& wanted);

/// Usual units of the same kind in words, the key's own unit first: "s, ms, us or min".
std::string units_that_fit(std::string_view wanted);

}  // namespace text
