// SPDX-License-Identifier: Apache-2.0
// Splits a line of a table into cells and reads a cell as a number.
#pragma once
#include <optional>
#include <string_view>
#include <vector>

namespace text {

/// Returns the cell without surrounding blanks and quotes.
std::string_view bare_cell(std::string_view text);

/// A line's cells, bare. Empty cells at the end are dropped. A quoted text is one cell, commas included.
std::vector<std::string_view> cells_of_line(std::string_view line, char separator);

/// The number in the whole cell times 10^ten, rounded once. A comma is a decimal point: between cells separated
/// by ';', tab or blanks, and within quotes if commas separate the cells.
std::optional<double> number_in(std::string_view cell, int ten = 0);

/// The separator of a row, a line whose first cell is a number: ';', tab, ',' or a blank. Empty for other lines.
std::optional<char> separator_of_row(std::string_view line);

}  // namespace text
