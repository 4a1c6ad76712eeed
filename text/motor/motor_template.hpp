// SPDX-License-Identifier: Apache-2.0
// Writes an empty motor file in the words of a trade, to be filled in from a printed sheet.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/base/result.hpp"
#include "text/rooms.hpp"

namespace text {

/// The trades whose sheets have a template: maxon, drone, servo, linear, firmware.
std::vector<std::string> template_styles();

/// The file's text. Meaning, unit and frames of every line come from the description of the keys. Lines that
/// a model needs are open (`value = nan`, refused until filled in), the others are commented out. Problem: an
/// unknown style.
base::Result<std::string> motor_template(std::string_view style, const std::string& name);

}  // namespace text
