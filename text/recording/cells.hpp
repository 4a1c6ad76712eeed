// SPDX-License-Identifier: Apache-2.0
// Splits a line of a table into cells and reads a cell as a number.
#pragma once
#include <optional>
#include <string_view>
#include <vector>

namespace text {

/// Returns the cell's text without surrounding blanks and quotes.
std::string_view bare_cell(std::string_view text);

/// Returns the bare cells of a line. Empty cells at the end are left out. A quoted text is one cell,
/// including its commas.
std::vector<std::string_view> cells_of_line(std::string_view line, char separator);

/// The number times 10^ten if the whole cell is a number, rounded once. A comma is a decimal point in two
/// cases: between cells separated by ';', tab or blanks, and within quotes if commas separate the cells.
std::optional<double> number_in(std::string_view cell, int ten = 0);

/// The separator of a row: ';', tab, ',' or a blank. A row is a line whose first cell is a number. Empty for
/// other lines.
std::optional<char> separator_of_row(std::string_view line);

}  // namespace text
