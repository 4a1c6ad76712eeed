// SPDX-License-Identifier: Apache-2.0
#include "text/recording/encoding.hpp"

#include <cstddef>
#include <cstdint>

namespace text {
namespace {

void add_utf8(std::string& out, std::uint32_t c) {
  if (c < 0x80U) {
    out += static_cast<char>(c);
  } else if (c < 0x800U) {
    out += static_cast<char>(0xC0U | c >> 6);
    out += static_cast<char>(0x80U | (c & 0x3FU));
  } else {
    out += static_cast<char>(0xE0U | c >> 12);
    out += static_cast<char>(0x80U | (c >> 6 & 0x3FU));
    out += static_cast<char>(0x80U | (c & 0x3FU));
  }
}

/// The characters that CP1252 has for the bytes 0x80 to 0x9F; 0xFFFD for a byte without a character. All
/// other bytes equal their code points.
constexpr std::uint16_t above_ascii[32] = {0x20AC, 0xFFFD, 0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021,
                                           0x02C6, 0x2030, 0x0160, 0x2039, 0x0152, 0xFFFD, 0x017D, 0xFFFD,
                                           0xFFFD, 0x2018, 0x2019, 0x201C, 0x201D, 0x2022, 0x2013, 0x2014,
                                           0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0xFFFD, 0x017E, 0x0178};

std::string from_cp1252(std::string_view bytes) {
  std::string out;
  out.reserve(bytes.size() + bytes.size() / 8);
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    add_utf8(out, byte >= 0x80U && byte < 0xA0U ? above_ascii[byte - 0x80U] : byte);
  }
  return out;
}

/// Characters beyond the first 65536, which no table needs, become replacement characters.
std::string from_utf16(std::string_view bytes, bool big_endian) {
  std::string out;
  for (std::size_t n = 0; n + 1 < bytes.size(); n += 2) {
    const auto first = static_cast<unsigned char>(bytes[n]),
               second = static_cast<unsigned char>(bytes[n + 1]);
    const std::uint32_t c = big_endian ? first << 8U | second : second << 8U | first;
    add_utf8(out, c >= 0xD800U && c < 0xE000U ? 0xFFFDU : c);
  }
  return out;
}

/// The number of bytes that follow a character's first byte; 4 if no character begins with this byte.
std::size_t following(unsigned char c) {
  if (c < 0x80U) return 0;
  if (c >= 0xC2U && c < 0xE0U) return 1;
  if (c >= 0xE0U && c < 0xF0U) return 2;
  return c >= 0xF0U && c < 0xF5U ? 3 : 4;
}

bool is_utf8(std::string_view text) {
  for (std::size_t n = 0; n < text.size();) {
    std::size_t more = following(static_cast<unsigned char>(text[n++]));
    if (more == 4) return false;
    for (; more > 0; --more, ++n)
      if (n == text.size() || (static_cast<unsigned char>(text[n]) & 0xC0U) != 0x80U) return false;
  }
  return true;
}

/// Replaces all line ends by "\n", in place.
void with_plain_line_ends(std::string& text) {
  std::size_t to = 0;
  for (std::size_t n = 0; n < text.size(); ++n) {
    if (text[n] != '\r') {
      text[to++] = text[n];
    } else if (n + 1 == text.size() || text[n + 1] != '\n') {
      text[to++] = '\n';
    }
  }
  text.resize(to);
}

/// Whether the text has bytes that occur only in binary files.
bool is_binary(std::string_view text) {
  constexpr std::size_t looked_at = 1 << 16;
  return text.substr(0, looked_at).find('\0') != std::string_view::npos;
}

}  // namespace

std::optional<std::string> plain_text(std::string_view bytes) {
  std::string out;
  const bool little = bytes.starts_with("\xff\xfe"), big = bytes.starts_with("\xfe\xff");
  if (little || big) {
    out = from_utf16(bytes.substr(2), big);
  } else {
    if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
    if (is_binary(bytes)) return {};
    out = is_utf8(bytes) ? std::string(bytes) : from_cp1252(bytes);
  }
  if (is_binary(out)) return {};
  with_plain_line_ends(out);
  return out;
}

}  // namespace text
