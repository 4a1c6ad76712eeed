// SPDX-License-Identifier: Apache-2.0
// Gives the cure for a TOML syntax error.
#pragma once
#include <string_view>

#include "text/rooms.hpp"

namespace text {

/// Returns the cure that corrects the file. `met` is the parser's message.
std::string_view syntax_cure(std::string_view met);

}  // namespace text
