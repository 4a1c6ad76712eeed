// SPDX-License-Identifier: Apache-2.0
// Writes a scenario as a file.
#pragma once
#include <string>
#include <vector>

#include "sixstep/study/scenario/scenario.hpp"
#include "text/rooms.hpp"

namespace text {

/// The scenario as TOML that reads back as the same scenario, to the bit. It contains the values that differ
/// from the defaults, in the order of the descriptions. It names the motor and has only those values of the
/// motor's sheet that differ from the motor's file (motor_sheet). Each of `comments` becomes a line above the
/// keys.
std::string scenario_text(const study::Scenario& scenario, const std::vector<std::string>& comments = {});

/// A motor's file with all values of the sheet. It reads back as the same sheet, and names no other file.
std::string sheet_text(const design::Sheet& sheet);

/// One key as written in the file.
struct WrittenValue {
  std::string path;  ///< "pwm.period_s"; in lists "require[0].metric"
  std::string text;  ///< as TOML
  bool usual;        ///< true: the value is the same if the key is left out
};

/// Every key that has a value. Of the motor's sheet, only the keys whose values differ from the motor's file.
std::vector<WrittenValue> scenario_values(const study::Scenario& scenario);

}  // namespace text
