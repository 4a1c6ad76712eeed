// SPDX-License-Identifier: Apache-2.0
// What to do about a file that is no TOML.
#pragma once
#include <string_view>

#include "text/rooms.hpp"

namespace text {

/// The parser says what it met; what its writer probably meant, and has to write instead, is said here.
std::string_view syntax_cure(std::string_view met);

}  // namespace text
