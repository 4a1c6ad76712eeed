// SPDX-License-Identifier: Apache-2.0
// A motor's sheet, its model and its check as text and as JSON.
#pragma once
#include <string>
#include <vector>

#include "sixstep/design/sheet/sheet_check.hpp"
#include "text/rooms.hpp"

namespace text {

/// One row per value that the sheet gives: as printed, with unit, frame and source.
std::string sheet_table(const design::Sheet& sheet);

/// The constants of the model with what each was read from, and friction between its extremes.
std::string model_table(const design::Sheet& sheet, const design::SheetCheck& check);

/// The relations, then the model, then what it leaves alone and why; the last line is the verdict.
std::string check_report(const design::Sheet& sheet, const design::SheetCheck& check);

/// Poles, voltage, R, K_t, J, and why where it cannot be simulated: one line of `motor list`, for a table
/// whose first column is `width` wide.
std::string motor_line(const std::string& name, const design::Sheet& sheet, std::size_t width);
std::string motor_line_heading(std::size_t width);

struct NamedSheet {
  std::string name;  ///< as a scenario says it
  design::Sheet sheet;
};

/// `motor list` for programs: an array of the same columns in SI, null where a sheet is silent.
std::string motor_list_json(const std::vector<NamedSheet>& motors);

/// All of it for programs; numbers in SI, lines of the sheet in their own unit.
std::string motor_json(const design::Sheet& sheet, const design::SheetCheck& check);

}  // namespace text
