// SPDX-License-Identifier: Apache-2.0
// Names of others in tables that spreadsheets open (escape.hpp has the other targets).
#pragma once
#include <string>
#include <string_view>

namespace text {

/// Visible, and with ' before what a spreadsheet would take for a formula.
std::string cell_name(std::string_view text);

/// The same as a cell of CSV, in quotes where it has to be.
std::string csv_cell(std::string_view text);

}  // namespace text
