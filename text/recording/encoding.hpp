// SPDX-License-Identifier: Apache-2.0
// The bytes of a file as UTF-8 with one line end, whoever wrote them.
#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace text {

/// UTF-8 as it stands, UTF-16 with its byte order mark, and CP1252 for bytes that are no UTF-8: 0xB5 is the micro sign there and 0xB0
/// the degree sign, as older instruments write them. Marks at the start are gone, "\r\n" and "\r" are "\n". Nothing for bytes that are
/// no text.
std::optional<std::string> plain_text(std::string_view bytes);

}  // namespace text
