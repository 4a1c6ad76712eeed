// SPDX-License-Identifier: Apache-2.0
#include "text/toml/nesting.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace text {
namespace {

/// The position after the string that begins at `at`, or the end of the text. If the string is not closed on
/// its line, the position is the end of the line; the parser will report the open string.
std::size_t behind_string(std::string_view text, std::size_t at) {
  const char quote = text[at];
  const bool whole = text.substr(at, 3) == std::string(3, quote);
  const std::size_t marks = whole ? 3 : 1;
  for (at += marks; at < text.size(); ++at) {
    if (quote == '"' && text[at] == '\\')
      ++at;
    else if (!whole && text[at] == '\n')
      return at;
    else if (text[at] == quote && (!whole || text.substr(at, 3) == std::string(3, quote)))
      return at + marks;
  }
  return text.size();
}

base::Problem too_deep(std::string_view name, std::string_view text, std::size_t at) {
  const std::string_view before = text.substr(0, at);
  const std::size_t line_start = before.rfind('\n') + 1;  // 0 on the first line, because npos + 1 is 0
  return {.where = fmt::format("{}:{}:{}:", name, 1 + std::count(before.begin(), before.end(), '\n'),
                               at - line_start + 1),
          .limit = fmt::format("nests deeper than {} tables or lists", deepest),
          .cure = "remove levels: the deepest keys have three parts, as control.current.settle_s"};
}

}  // namespace

std::optional<base::Problem> nests_too_deep(std::string_view name, std::string_view text) {
  std::size_t brackets = 0, parts = 0;  // number of open brackets at this place; number of dots in the
                                        // present key
  for (std::size_t at = 0; at < text.size(); ++at) {
    switch (text[at]) {
      case '"':
      case '\'':
        at = behind_string(text, at) - 1;
        break;
      case '#':
        at = std::min(text.find('\n', at), text.size()) - 1;
        break;
      case '[':
      case '{':
        ++brackets;
        parts = 0;
        break;
      case ']':
      case '}':
        brackets -= brackets > 0;
        parts = 0;
        break;
      case '\n':
      case '=':
      case ',':
        parts = 0;
        break;
      case '.':
        ++parts;
        break;
      default:
        break;
    }
    if (brackets > deepest || parts > deepest) return too_deep(name, text, at);
  }
  return {};
}

}  // namespace text
