// SPDX-License-Identifier: Apache-2.0
// Prints a motor's sheet, its model and its check as text and as JSON.
#pragma once
#include <string>
#include <vector>

#include "sixstep/design/sheet/sheet_check.hpp"
#include "text/rooms.hpp"

namespace text {

/// One row per value of the sheet: as printed, with unit, frame and source.
std::string sheet_table(const design::Sheet& sheet);

/// The constants of the model with their sources; friction with its least and greatest value.
std::string model_table(const design::Sheet& sheet, const design::SheetCheck& check);

/// The check: the relations, the model, and the values that the check does not use with the reason. The last
/// line is the verdict.
std::string check_report(const design::Sheet& sheet, const design::SheetCheck& check);

/// One line of `motor list`: poles, voltage, R, K_t, J, and the reason if the motor cannot be simulated.
/// `width` is the width of the first column.
std::string motor_line(const std::string& name, const design::Sheet& sheet, std::size_t width);
std::string motor_line_heading(std::size_t width);

struct NamedSheet {
  std::string name;  ///< the name that a scenario uses
  design::Sheet sheet;
};

/// `motor list` as JSON: an array with the same columns in SI, null for a value that the sheet omits.
std::string motor_list_json(const std::vector<NamedSheet>& motors);

/// Sheet, model and check as JSON: numbers in SI, lines of the sheet in their own unit.
std::string motor_json(const design::Sheet& sheet, const design::SheetCheck& check);

}  // namespace text
