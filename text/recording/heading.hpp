// SPDX-License-Identifier: Apache-2.0
// A column's heading: its name, and the word that stands where a unit belongs.
#pragma once
#include <string>
#include <string_view>

namespace text {

/// The one place that knows units as instruments spell them: "s" of "second", "(ms)", "uS" and "microseconds"; as units.hpp spells it.
/// Empty for what is no unit.
std::string unit_in_words(std::string_view cell);

struct Heading {
  std::string name;
  std::string unit;      ///< as units.hpp spells it
  std::string odd_unit;  ///< a word in the place of the unit that is none
  /// The unit is a letter behind the name, "u_ab_V" or "phase_A": it may as well be a part of the name.
  bool letter = false;
};

/// "u_ab" and "V" of "u_ab [V]", "u_ab (V)", "u_ab / V", "u_ab in V", "u_ab V", "u_ab_V" and "u_ab.v"; no name in "in s" and "(V)".
Heading heading_of(std::string_view cell);

/// Letters and digits in lower case: "U_ab" is "uab".
std::string bare_name(std::string_view heading);

}  // namespace text
