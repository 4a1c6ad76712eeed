// SPDX-License-Identifier: Apache-2.0
// Writes one key of a file to be filled in: its meaning as a comment, then the line itself, active or
// commented out.
#pragma once
#include <string>
#include <string_view>

#include "text/keys/key_catalog.hpp"
#include "text/rooms.hpp"

namespace text {

/// Text as comment lines of at most `template_width` characters; further lines after `indent` spaces.
std::string wrapped_comment(std::string_view text, std::size_t indent = 0);
inline constexpr std::size_t template_width = 110;

struct TemplateLine {
  std::string_view key;
  std::string_view value;   ///< value as TOML
  bool open = true;         ///< false: commented out, so that it has no effect yet
  bool explained = true;    ///< false: only the line, because its meaning is written elsewhere
  std::string_view more{};  ///< text after meaning, unit and range
};

/// Returns "key = value  # meaning [unit], range". A long comment, and the words of an enumeration, are
/// written above the line.
std::string template_line(const KeyEntry& entry, const TemplateLine& line);

}  // namespace text
