// SPDX-License-Identifier: Apache-2.0
// Writes an empty motor file to be filled in from a printed sheet, in the words of one industry.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/base/result.hpp"
#include "text/rooms.hpp"

namespace text {

/// The names of motor_styles().
std::vector<std::string> template_styles();

/// Returns the file's text. Meaning, unit and frames of every line come from the description of the keys.
/// Lines that a model needs are active (`value = nan`, refused until filled in); the other lines are
/// commented out. Problem: an unknown style.
base::Result<std::string> motor_template(std::string_view style, const std::string& name);

}  // namespace text
