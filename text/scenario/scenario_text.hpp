// SPDX-License-Identifier: Apache-2.0
// A scenario as the file that says it.
#pragma once
#include <string>
#include <vector>

#include "sixstep/study/scenario/scenario.hpp"
#include "text/rooms.hpp"

namespace text {

/// TOML that reads back as the same scenario, to the bit: what differs from the defaults, in the order of the
/// descriptions. The motor is named; of its sheet the values are written that are not those of its file (motor_sheet). Each of
/// `comments` becomes a line of its own above it.
std::string scenario_text(const study::Scenario& scenario, const std::vector<std::string>& comments = {});

/// One key as the file would say it.
struct WrittenValue {
  std::string path;  ///< "pwm.period_s"; in lists "require[0].metric"
  std::string text;  ///< as TOML
  bool usual;        ///< what holds too where the key is left out
};

/// Every key that has a value; of the motor's sheet those that are not its file's.
std::vector<WrittenValue> scenario_values(const study::Scenario& scenario);

}  // namespace text
