// SPDX-License-Identifier: Apache-2.0
// Converts the bytes of a file to UTF-8 with one line end.
#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace text {

/// Reads UTF-8, UTF-16 with a byte order mark, and otherwise CP1252, where 0xB5 is the micro sign and 0xB0
/// the degree sign, as older instruments write them. Byte order marks are removed, "\r\n" and "\r" become
/// "\n". Empty for bytes that are no text.
std::optional<std::string> plain_text(std::string_view bytes);

}  // namespace text
