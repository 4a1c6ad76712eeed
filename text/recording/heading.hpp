// SPDX-License-Identifier: Apache-2.0
// Splits a column's heading into its name and its unit.
#pragma once
#include <string>
#include <string_view>

namespace text {

/// The unit in the spelling of units.hpp, from the spellings of instruments: "s" for "second"; also "(ms)", "uS"
/// and "microseconds". Empty if it is no unit. This is the only place with those spellings.
std::string unit_in_words(std::string_view cell);

struct Heading {
  std::string name;
  std::string unit;      ///< as units.hpp spells it
  std::string odd_unit;  ///< a word in the place of the unit that is no unit
  /// The unit is a letter after the name, "u_ab_V" or "phase_A", which may also be part of the name.
  bool letter = false;
};

/// "u_ab" and "V" of "u_ab [V]", "u_ab (V)", "u_ab / V", "u_ab in V", "u_ab V", "u_ab_V" and "u_ab.v"; no name in "in s" and "(V)".
Heading heading_of(std::string_view cell);

/// Letters and digits in lower case: "U_ab" is "uab".
std::string bare_name(std::string_view heading);

}  // namespace text
