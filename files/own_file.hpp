// SPDX-License-Identifier: Apache-2.0
// Recognises sixstep's files by their first lines. Other files are replaced only on request.
#pragma once
#include <string>
#include <string_view>

#include "files/rooms.hpp"

namespace files {

/// Returns the text, which the user may edit, after a TOML comment with the command that wrote it. The
/// comment contains a digest of the text, by which later changes are detected.
std::string with_own_mark(std::string_view command, const std::string& text);

/// The first lines of a CSV table: the program, and the command that wrote the table.
std::string csv_head(std::string_view command);

/// Whether the path is a regular, non-empty file that sixstep has not written. Every output of sixstep begins
/// with a comment of its format that contains "sixstep" and the version. Also true for a text of
/// with_own_mark() that was changed, and for a file that cannot be read.
bool is_foreign(const std::string& path);

}  // namespace files
