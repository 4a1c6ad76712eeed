// SPDX-License-Identifier: Apache-2.0
#include "text/escape/escape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace text {
namespace {

constexpr char32_t replacement = 0xFFFD;
constexpr std::string_view replacement_bytes = "\xEF\xBF\xBD";

bool is_ascii_word(unsigned char c) {
  return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

/// Whether a character may act on a program: controls (C0, DEL, C1), line ends, controls of bidirectional
/// text, and characters without width, which can make two different names look equal. The two joiners
/// (U+200C, U+200D) are allowed, because some scripts need them.
bool acts(char32_t c) {
  return c < 0x20 || (c >= 0x7F && c < 0xA0) || c == 0x061C || c == 0x180E || c == 0x200B || c == 0x200E ||
         c == 0x200F || (c >= 0x2028 && c <= 0x202E) || (c >= 0x2060 && c <= 0x206F) || c == 0xFEFF ||
         (c >= 0xFFF9 && c <= 0xFFFB);
}

/// Whether the character at `at` is kept with Lines::kept: a tab, a line end, or the carriage return before a
/// line end.
bool keeps_lines(std::string_view text, std::size_t at) {
  return text[at] == '\n' || text[at] == '\t' || text.substr(at, 2) == "\r\n";
}

}  // namespace

char32_t next_character(std::string_view text, std::size_t& at) {
  const auto byte = [&](std::size_t n) { return n < text.size() ? static_cast<unsigned char>(text[n]) : 0U; };
  const unsigned first = byte(at++);
  if (first < 0x80) return first;
  if (first < 0xC2 || first > 0xF4) return replacement;
  const std::size_t more = first >= 0xF0 ? 3 : first >= 0xE0 ? 2 : 1;
  char32_t character = first & (0x3FU >> more);
  for (std::size_t n = 0; n < more; ++n) {
    if ((byte(at + n) & 0xC0U) != 0x80U) return replacement;
    character = character << 6U | (byte(at + n) & 0x3FU);
  }
  // Bytes that encode no character: more bytes than needed, half of a surrogate pair, or a number beyond the
  // last code point.
  constexpr char32_t least[] = {0, 0x80, 0x800, 0x10000};
  if (character < least[more] || (character >= 0xD800 && character < 0xE000) || character > 0x10FFFF)
    return replacement;
  at += more;
  return character;
}

std::string visible(std::string_view text, Lines lines) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t begin = at;
    while (at < text.size() && text[at] >= ' ' && text[at] < 0x7F) ++at;
    if (at > begin) {  // plain characters are copied together, because nearly all data of a page is plain
      out += text.substr(begin, at - begin);
      continue;
    }
    const char32_t c = next_character(text, at);
    if (c == replacement)
      out += replacement_bytes;
    else if (acts(c) && !(lines == Lines::kept && keeps_lines(text, begin)))
      out += fmt::format("\\u{:04x}", static_cast<std::uint32_t>(c));
    else
      out += text.substr(begin, at - begin);
  }
  return out;
}

std::string shell_word(std::string_view word) {
  constexpr std::string_view harmless = "-_./=+,:@%";
  const auto plain = [&](unsigned char c) {
    return is_ascii_word(c) || harmless.find(static_cast<char>(c)) != std::string_view::npos;
  };
  // A word that begins with = needs quotes, because zsh expands it.
  if (!word.empty() && word.front() != '=' && std::all_of(word.begin(), word.end(), plain))
    return std::string(word);
  std::string out;
  if (visible(word) == word) {
    for (const char c : word) c == '\'' ? out += "'\\''" : out += c;
    return fmt::format("'{}'", out);
  }
  for (const char c : word) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '\'' || c == '\\')
      out.append(1, '\\').append(1, c);
    else if (byte < 0x20 || byte >= 0x7F)
      out += fmt::format("\\{:03o}", byte);  // octal, because \x would include hexadecimal digits that follow
    else
      out += c;
  }
  return fmt::format("$'{}'", out);
}

std::string markup_text(std::string_view text, Lines lines) {
  std::string out;
  out.reserve(text.size() + text.size() / 8);
  for (const char c : visible(text, lines)) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string url_of_name(std::string_view name) {
  std::string out;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (is_ascii_word(byte) || c == '-' || c == '.' || c == '_' || c == '~')
      out += c;
    else
      out += fmt::format("%{:02X}", byte);
  }
  return out;
}

std::string comment_text(std::string_view text) {
  std::string out = visible(text);
  for (;;) {
    if (out.ends_with(' ') || out.ends_with('\\'))
      out.pop_back();
    else if (out.ends_with("?"
                           "?/"))
      out.resize(out.size() - 3);
    else
      return out;
  }
}

std::string vcd_text(std::string_view text) {
  std::string out = visible(text);
  for (std::size_t at = 0; (at = out.find("$end", at)) != std::string::npos;) out[at] = '?';
  return out;
}

std::string toml_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return visible(out) + "\"";
}

}  // namespace text
