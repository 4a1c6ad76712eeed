// SPDX-License-Identifier: Apache-2.0
// Gives the cure for a TOML syntax error.
#pragma once
#include <string_view>

#include "text/rooms.hpp"

namespace text {

/// `met`: the parser's message. Returns what the writer has to change.
std::string_view syntax_cure(std::string_view met);

}  // namespace text
