// SPDX-License-Identifier: Apache-2.0
// Whose file it is: what sixstep writes says so in its first lines, and nothing else is written over unasked.
#pragma once
#include <string>
#include <string_view>

#include "files/rooms.hpp"

namespace files {

/// A text that is the user's to go on with: below a comment of TOML that tells by which command it was made
/// and, by a digest, whether it still is as it was.
std::string with_own_mark(std::string_view command, const std::string& text);

/// The first lines of a table of CSV: by what and by which command it was made.
std::string csv_head(std::string_view command);

/// A regular file with something in it that does not begin as one of sixstep's outputs does: "sixstep" and
/// its version in the words of the format. So is a text with_own_mark() that was changed since, and what
/// cannot be read.
bool is_foreign(const std::string& path);

}  // namespace files
