// SPDX-License-Identifier: Apache-2.0
// Makes foreign names harmless in tables that spreadsheets open (escape.hpp has the other targets).
#pragma once
#include <string>
#include <string_view>

namespace text {

/// Returns visible(text), with ' in front if a spreadsheet would treat the text as a formula.
std::string cell_name(std::string_view text);

/// cell_name() as a cell of CSV, in quotes if needed.
std::string csv_cell(std::string_view text);

}  // namespace text
