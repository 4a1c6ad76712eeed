// SPDX-License-Identifier: Apache-2.0
// The parts of read_recording().
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace text {

/// A line's cells, without blanks and quotes around them. Empty ones at the end are none.
std::vector<std::string_view> cells_of_line(std::string_view line, char separator);

/// What parts the cells of a line of numbers: ';', tab, ',' or a blank.
char separator_of_line(std::string_view line);

/// The whole cell as a number. With ';' or tab between cells a comma is a decimal point.
std::optional<double> number_in(std::string_view cell, char separator);

/// "u_ab" and "V" of "u_ab [V]", "u_ab (V)" and "u_ab_V"; the unit as units.hpp spells it.
struct Heading {
  std::string name, unit;
};
Heading heading_of(std::string_view cell);

/// "s" of "second", "(ms)" and "Volts": as units.hpp spells it; empty for what is no unit.
std::string unit_in_words(std::string_view cell);

}  // namespace text
