// SPDX-License-Identifier: Apache-2.0
// Writes a scenario as a file.
#pragma once
#include <string>
#include <vector>

#include "sixstep/study/scenario/scenario.hpp"
#include "text/rooms.hpp"

namespace text {

/// TOML that reads back as the same scenario, to the bit: the values that differ from the defaults, in the order
/// of the descriptions. It names the motor and writes only those values of its sheet that differ from the
/// motor's file (motor_sheet). Each of `comments` becomes a line above it.
std::string scenario_text(const study::Scenario& scenario, const std::vector<std::string>& comments = {});

/// A motor's file with all values of the sheet; it reads back as the same sheet, and names no other file.
std::string sheet_text(const design::Sheet& sheet);

/// One key as the file has it.
struct WrittenValue {
  std::string path;  ///< "pwm.period_s"; in lists "require[0].metric"
  std::string text;  ///< as TOML
  bool usual;        ///< the same value holds if the key is left out
};

/// Every key that has a value; of the motor's sheet only those that differ from its file.
std::vector<WrittenValue> scenario_values(const study::Scenario& scenario);

}  // namespace text
