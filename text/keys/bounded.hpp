// SPDX-License-Identifier: Apache-2.0
// Shortens texts for messages, because a quoted value of a file may have ten million characters.
#pragma once
#include <string>

#include "sixstep/base/problem.hpp"
#include "text/rooms.hpp"

namespace text {

/// Shortens a text longer than `most` bytes to its beginning and its end. Both cuts lie between characters.
inline std::string bounded(std::string text, std::size_t most) {
  if (text.size() <= most) return text;
  const auto inside = [&text](std::size_t at) {
    return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U;
  };
  std::size_t begin = most * 3 / 4, end = text.size() - most / 4;
  while (begin > 0 && inside(begin)) --begin;
  while (inside(end)) ++end;
  return text.substr(0, begin) + " ... " + text.substr(end);
}

/// Shortens each text of a Problem, because each may contain a long name or long words of a file.
inline base::Problem bounded(base::Problem p) {
  return {bounded(std::move(p.where), 1000), bounded(std::move(p.value), 200),
          bounded(std::move(p.limit), 1000), bounded(std::move(p.cure), 1000)};
}

}  // namespace text
