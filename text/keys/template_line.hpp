// SPDX-License-Identifier: Apache-2.0
// A key of a file to be filled in: what it means as a comment, then the line itself, open or behind a #.
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
  std::string_view value;   ///< as TOML
  bool open = true;         ///< else behind a #, not to count yet
  bool explained = true;    ///< else the line alone: its meaning stands elsewhere
  std::string_view more{};  ///< to be said behind meaning, unit and range
};

/// "key = value  # meaning [unit], range"; what does not fit into one line, and the words of an enumeration,
/// stand above it.
std::string template_line(const KeyEntry& entry, const TemplateLine& line);

}  // namespace text
