// SPDX-License-Identifier: Apache-2.0
#include "io/export/comment_text.hpp"

namespace io {
namespace {

/// What a compiler takes for "the comment goes on in the next line", spaces behind it included.
bool drop_continuation(std::string& line) {
  constexpr std::string_view trigraph = "?\?/";
  if (line.empty()) return false;
  if (line.back() == ' ' || line.back() == '\\') {
    line.pop_back();
    return true;
  }
  if (!line.ends_with(trigraph)) return false;
  line.resize(line.size() - trigraph.size());
  return true;
}

}  // namespace

std::string comment_text(std::string_view text) {
  std::string out;
  for (std::size_t n = 0; n < text.size(); ++n) {
    const auto byte = [&](std::size_t k) {
      return n + k < text.size() ? static_cast<unsigned char>(text[n + k]) : 0u;
    };
    const unsigned last = byte(2);
    const bool reorders =
        byte(0) == 0xe2 &&
        ((byte(1) == 0x80 && (last == 0x8e || last == 0x8f || (last >= 0xaa && last <= 0xae))) ||
         (byte(1) == 0x81 && last >= 0xa6 && last <= 0xa9));
    if (reorders) n += 2;
    out += reorders || byte(0) < 0x20 || byte(0) == 0x7f ? ' ' : text[n];
  }
  while (drop_continuation(out)) {
  }
  return out;
}

}  // namespace io
