// SPDX-License-Identifier: Apache-2.0
#include "report/html.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstdint>
#include <vector>

#include "text/escape/escape.hpp"

namespace report {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::string base64_bytes(std::span<const std::uint8_t> bytes) {
  static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text((bytes.size() + 2) / 3 * 4, '=');
  const auto put = [&text](std::size_t at, std::uint32_t triple, std::size_t signs) {
    for (std::size_t k = 0; k < signs; ++k) text[at + k] = digits[triple >> (18 - 6 * k) & 63u];
  };
  const std::size_t whole = bytes.size() / 3, over = bytes.size() % 3;
  for (std::size_t n = 0; n < whole; ++n)
    put(4 * n, std::uint32_t{bytes[3 * n]} << 16 | std::uint32_t{bytes[3 * n + 1]} << 8 | bytes[3 * n + 2],
        4);
  if (over > 0)
    put(4 * whole,
        std::uint32_t{bytes[3 * whole]} << 16 | (over > 1 ? std::uint32_t{bytes[3 * whole + 1]} << 8 : 0u),
        over + 1);
  return text;
}

template <class Bits, class Real>
Bytes little_endian(std::span<const Real> values) {
  Bytes bytes(values.size() * sizeof(Real));
  for (std::size_t n = 0; n < values.size(); ++n) {
    const Bits bits = std::bit_cast<Bits>(values[n]);
    for (std::size_t k = 0; k < sizeof(Real); ++k)
      bytes[n * sizeof(Real) + k] = static_cast<std::uint8_t>(bits >> (8 * k) & 0xffu);
  }
  return bytes;
}

}  // namespace

std::string escaped(std::string_view text) { return text::markup_text(text, text::Lines::kept); }

namespace {

/// Writes a subscript after the underscore of a short name: K_t, I_stall, tau_m. A key such as resistance_ohm
/// is unchanged.
std::string word_with_subscript(std::string_view word) {
  constexpr std::size_t longest_name = 3;
  const std::size_t cut = word.find('_');
  const bool symbol = cut != std::string_view::npos && cut > 0 && cut <= longest_name &&
                      cut + 1 < word.size() && word.find('_', cut + 1) == std::string_view::npos;
  if (!symbol) return std::string(word);
  return fmt::format("{}<sub>{}</sub>", word.substr(0, cut), word.substr(cut + 1));
}

}  // namespace

std::string with_subscripts(std::string_view words) {
  const std::string shown = text::visible(words);
  std::string_view text = shown;
  const auto in_word = [](char c) {
    return c < 0 || c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0;
  };
  std::string out;
  while (!text.empty()) {
    const std::size_t size =
        static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), in_word) - text.begin());
    out += size > 0 ? word_with_subscript(text.substr(0, size)) : escaped(text.substr(0, 1));
    text.remove_prefix(size > 0 ? size : 1);
  }
  return out;
}

std::string typeset(std::string_view formula) {
  static constexpr std::pair<std::string_view, std::string_view> signs[] = {
      {"+-", "±"}, {"^2", "²"}, {" - ", " − "}};
  static constexpr std::pair<std::string_view, std::string_view> words[] = {
      {"sqrt", "√"}, {"xi", "ξ"},   {"w0", "ω_0"}, {"a0", "a_0"}, {"b0", "b_0"},
      {"c0", "c_0"}, {"c1", "c_1"}, {"d0", "d_0"}, {"d1", "d_1"}};
  const auto wordy = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
  std::string text;
  while (!formula.empty()) {
    std::size_t length = 0;
    while (length < formula.size() && wordy(formula[length])) ++length;
    const bool word = length > 0;
    std::string_view piece = formula.substr(0, word ? length : 1), shown = piece;
    if (word) {
      for (const auto& [typed, printed] : words)
        if (piece == typed) shown = printed;
    } else {
      for (const auto& [typed, printed] : signs)
        if (formula.starts_with(typed)) piece = typed, shown = printed;
      if (piece == "-" && (text.empty() || text.ends_with('('))) shown = "−";  // a minus sign, not a hyphen
    }
    text += shown;
    formula.remove_prefix(piece.size());
  }
  return with_subscripts(text);
}

std::string script_safe(std::string_view json) {
  // In JSON a '<' occurs only inside strings, where \u003c has the same meaning.
  const std::string shown = text::visible(json, text::Lines::kept);
  std::string out;
  out.reserve(shown.size());
  for (std::size_t begin = 0;;) {
    const std::size_t sign = shown.find('<', begin);
    out.append(shown, begin, sign == shown.npos ? sign : sign - begin);
    if (sign == shown.npos) return out;
    out += "\\u003c";
    begin = sign + 1;
  }
}

std::string base64(std::span<const std::uint8_t> bytes) { return base64_bytes(bytes); }
std::string base64(std::span<const float> values) {
  return base64_bytes(little_endian<std::uint32_t>(values));
}
std::string base64(std::span<const double> values) {
  return base64_bytes(little_endian<std::uint64_t>(values));
}

std::string number_cell(const std::string& html) { return "<td class=\"num\">" + html + "</td>"; }

std::string table_head(std::initializer_list<std::string_view> names) {
  std::string out = "<thead><tr>";
  for (const std::string_view name : names)
    out += name.starts_with('#') ? fmt::format("<th class=\"num\">{}</th>", name.substr(1))
                                 : fmt::format("<th>{}</th>", name);
  return out + "</tr></thead>";
}

std::string filled(std::string_view page, std::initializer_list<Gap> gaps) {
  std::size_t size = page.size();
  for (const Gap& gap : gaps) size += gap.second.size();
  std::string out;
  out.reserve(size);
  while (true) {
    const std::size_t open = page.find("{{");
    const std::size_t close = open == page.npos ? page.npos : page.find("}}", open);
    if (close == page.npos) return out.append(page);
    out.append(page.substr(0, open));
    const std::string_view name = page.substr(open + 2, close - open - 2);
    for (const Gap& gap : gaps)
      if (gap.first == name) out.append(gap.second);
    page.remove_prefix(close + 2);
  }
}

}  // namespace report
