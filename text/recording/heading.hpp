// SPDX-License-Identifier: Apache-2.0
// Splits a column's heading into its name and its unit.
#pragma once
#include <string>
#include <string_view>

namespace text {

/// The unit in the spelling of units.hpp, from the spellings of instruments: "s" for "second"; also "(ms)",
/// "uS" and "microseconds". Empty if the cell is no unit. Only this function accepts these spellings.
std::string unit_in_words(std::string_view cell);

struct Heading {
  std::string name;
  std::string unit;      ///< spelling as in units.hpp
  std::string odd_unit;  ///< a word in the place of the unit that is not a unit
  /// The unit is a letter after the name, "u_ab_V" or "phase_A", which may also be part of the name.
  bool letter = false;
};

/// Splits a heading: name "u_ab" and unit "V" for "u_ab [V]", "u_ab (V)", "u_ab / V", "u_ab in V", "u_ab V",
/// "u_ab_V" and "u_ab.v". The name is empty for "in s" and "(V)".
Heading heading_of(std::string_view cell);

/// Letters and digits of a heading in lower case: "uab" for "U_ab".
std::string bare_name(std::string_view heading);

}  // namespace text
