// SPDX-License-Identifier: Apache-2.0
// A line of a table as cells, and a cell as a number.
#pragma once
#include <optional>
#include <string_view>
#include <vector>

namespace text {

/// Without blanks and quotes around it.
std::string_view bare_cell(std::string_view text);

/// A line's cells, bare. Empty ones at the end are none. What stands between two quotes is one cell, with the commas in it.
std::vector<std::string_view> cells_of_line(std::string_view line, char separator);

/// The whole cell as a number times 10^ten, rounded once. A comma is a decimal point: with ';', tab or blanks between cells, and in
/// quotes where commas part them.
std::optional<double> number_in(std::string_view cell, int ten = 0);

/// What parts the cells of a row, a line whose first cell is a number: ';', tab, ',' or a blank. Nothing for other lines.
std::optional<char> separator_of_row(std::string_view line);

}  // namespace text
