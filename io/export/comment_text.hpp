// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>

namespace io {

/// Text from a file or the command line in a line of a // comment: nothing in it may end the line, continue
/// it (a last backslash, or the trigraph for one), or reorder what is shown (the controls of bidirectional
/// text, U+200E, U+200F, U+202A-202E, U+2066-2069).
std::string comment_text(std::string_view text);

}  // namespace io
