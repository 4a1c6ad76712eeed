// SPDX-License-Identifier: Apache-2.0
#include "text/recording/cells.hpp"

#include <algorithm>
#include <charconv>
#include <string>

#include "text/keys/decimal_number.hpp"

namespace text {
namespace {

/// Replaces a decimal comma by a point. If no digit precedes or follows the point, a 0 is added there.
std::string as_decimal(std::string_view cell, bool decimal_comma) {
  std::string out(cell);
  if (decimal_comma) std::replace(out.begin(), out.end(), ',', '.');
  const std::size_t point = out.starts_with('-') ? 1 : 0;
  if (out.size() > point && out[point] == '.') out.insert(point, 1, '0');
  return out;
}

/// A number times a power of ten: "5e-1" times 10^3 is "5e2". Only the exponent changes.
std::optional<double> moved(std::string_view number, int ten) {
  const std::size_t e = std::min(number.find_first_of("eE"), number.size());
  int exponent = 0;
  if (e < number.size()) {
    const std::size_t digits = e + (number.substr(e + 1).starts_with('+') ? 2 : 1);
    const std::string_view rest = number.substr(digits);
    if (std::from_chars(rest.data(), rest.data() + rest.size(), exponent).ec != std::errc()) return {};
  }
  if (exponent > 10'000 || exponent < -10'000) return {};
  const std::string text = std::string(number.substr(0, e)) + "e" + std::to_string(exponent + ten);
  const DecimalNumber x = decimal_number(text);
  return x.kind == DecimalNumber::Kind::number ? std::optional(x.value) : std::nullopt;
}

/// The position of the closing quote of the cell that begins at `at`, if quotes enclose the whole cell; else
/// `at`. The search for the cell's separator begins at this position.
std::size_t behind_quotes(std::string_view line, std::size_t at, char separator) {
  const std::size_t open = line.find_first_not_of(' ', at);
  if (open == std::string_view::npos || line[open] != '"') return at;
  const std::size_t close = line.find('"', open + 1);
  if (close == std::string_view::npos) return at;
  const std::size_t next = line.find_first_not_of(" \r", close + 1);
  return next == std::string_view::npos || line[next] == separator || separator == ' ' ? close : at;
}

}  // namespace

std::string_view bare_cell(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\"'";
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::vector<std::string_view> cells_of_line(std::string_view line, char separator) {
  constexpr std::size_t most_columns = 1'000;
  std::vector<std::string_view> cells;
  std::size_t at = 0;
  while (at <= line.size() && cells.size() < most_columns) {
    const std::size_t cut = std::min(line.find(separator, behind_quotes(line, at, separator)), line.size());
    const std::string_view cell = bare_cell(line.substr(at, cut - at));
    if (separator != ' ' || !cell.empty()) cells.push_back(cell);
    at = cut + 1;
  }
  while (!cells.empty() && cells.back().empty()) cells.pop_back();
  return cells;
}

std::optional<double> number_in(std::string_view cell, int ten) {
  if (cell.starts_with('+')) cell.remove_prefix(1);
  if (cell.find_first_of("0123456789") == std::string_view::npos) return {};
  std::string text;
  const bool comma = cell.find(',') != std::string_view::npos;
  if (comma || cell.starts_with('.') || cell.starts_with("-.")) {
    text = as_decimal(cell, comma);
    cell = text;
  }
  const DecimalNumber x = decimal_number(cell);
  if (x.kind != DecimalNumber::Kind::number || x.size != cell.size()) return {};
  return ten == 0 || x.value == 0.0 ? std::optional(x.value) : moved(cell, ten);
}

std::optional<char> separator_of_row(std::string_view line) {
  std::optional<char> found;
  for (const char c : {';', '\t', ',', ' '}) {
    if (c != ' ' && line.find(c) == std::string_view::npos) continue;
    const std::vector<std::string_view> cells = cells_of_line(line, c);
    if (cells.empty() || !number_in(cells[0])) continue;
    // "0,5 1,2" also has a number before its first comma. But only blanks as separators make all cells
    // numbers.
    if (std::all_of(cells.begin(), cells.end(),
                    [](std::string_view cell) { return cell.empty() || number_in(cell).has_value(); }))
      return c;
    if (!found) found = c;
  }
  return found;
}

}  // namespace text
