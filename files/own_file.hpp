// SPDX-License-Identifier: Apache-2.0
// Recognises sixstep's own files by their first lines; other files are replaced only on request.
#pragma once
#include <string>
#include <string_view>

#include "files/rooms.hpp"

namespace files {

/// Returns the text, which the user may edit, below a TOML comment with the command that made it. The comment
/// has a digest that shows later changes.
std::string with_own_mark(std::string_view command, const std::string& text);

/// The first lines of a CSV table: program and command that made it.
std::string csv_head(std::string_view command);

/// Whether the path is a regular, non-empty file that does not begin like sixstep's outputs: with "sixstep"
/// and its version in the format's comment. Also true for a changed text with_own_mark(), and for a file that
/// cannot be read.
bool is_foreign(const std::string& path);

}  // namespace files
