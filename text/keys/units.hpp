// SPDX-License-Identifier: Apache-2.0
// Units as people write them, "20 ms" or "135 gcm2", and their values in the unit that a key carries.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/base/result.hpp"
#include "text/rooms.hpp"

namespace text {

/// kg, m, s, A, K, rad and the Celsius scale, which is no multiple of K.
using Dimension = std::array<int, 7>;

/// A value in this unit is `factor` times 10^ten of the one in SI. Decimal powers stand apart, for they cost
/// no rounding.
struct Unit {
  Dimension dimension{};
  int ten = 0;
  double factor = 1.0;
};

/// "mNm/A", "kg m2", "Nm/(rad/s)", "1/min", "%"; empty for what is no unit, the plain number 1 for "".
std::optional<Unit> unit_of(std::string_view text);

/// The same with the signs that few keyboards have and a data sheet's names of rpm as the tables spell them.
std::string plain_spelling(std::string_view unit);

/// Whether values convert. An angle is a number wherever torque or energy is involved (N m is J per rad); a
/// frequency is no speed.
bool same_kind(const Unit& a, const Unit& b);

/// A number with a unit behind it; empty where it begins with none.
struct Written {
  std::string number, unit;
};
std::optional<Written> split_number(std::string_view text);

/// The value of `written` in the unit `wanted`, with the Problem's limit and cure where there is none. Where
/// the units differ by a power of ten, it is the double nearest to the decimal: "0.572 mH" is 0.000572 as if
/// it were written so. Else, as for rpm in rad/s, up to three roundings more.
base::Result<double> in_unit(std::string_view written, std::string_view wanted);

/// Usual units of the same kind, the key's own first: "s, ms, us or min".
std::string units_that_fit(std::string_view wanted);

}  // namespace text
