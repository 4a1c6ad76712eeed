// SPDX-License-Identifier: Apache-2.0
#include "text/recording/recording_reader.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

#include "text/keys/decimal_number.hpp"
#include "text/keys/key_advice.hpp"
#include "text/keys/units.hpp"

namespace text {
namespace {

constexpr std::string_view blanks = " \t\r\"'";

std::string_view trimmed(std::string_view text, std::string_view of = blanks) {
  const std::size_t first = text.find_first_not_of(of);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(of) - first + 1);
}

bool is_time_or_voltage(std::string_view unit) {
  const std::optional<Unit> u = unit_of(unit);
  return !unit.empty() && u && (same_kind(*u, *unit_of("s")) || same_kind(*u, *unit_of("V")));
}

}  // namespace

std::vector<std::string_view> cells_of_line(std::string_view line, char separator) {
  constexpr std::size_t most_columns = 1'000;
  std::vector<std::string_view> cells;
  std::size_t at = 0;
  while (at <= line.size() && cells.size() < most_columns) {
    const std::size_t cut = std::min(line.find(separator, at), line.size());
    const std::string_view cell = trimmed(line.substr(at, cut - at));
    if (separator != ' ' || !cell.empty()) cells.push_back(cell);
    at = cut + 1;
  }
  while (!cells.empty() && cells.back().empty()) cells.pop_back();
  return cells;
}

char separator_of_line(std::string_view line) {
  for (const char c : {';', '\t', ','})
    if (line.find(c) != std::string_view::npos) return c;
  return ' ';
}

std::optional<double> number_in(std::string_view cell, char separator) {
  if (cell.starts_with('+')) cell.remove_prefix(1);
  std::string with_point;
  if ((separator == ';' || separator == '\t') && cell.find(',') != std::string_view::npos) {
    with_point = cell;
    std::replace(with_point.begin(), with_point.end(), ',', '.');
    cell = with_point;
  }
  // ".5" and "-.5", as some exporters have it.
  const std::size_t point = cell.starts_with('-') ? 1 : 0;
  if (cell.size() > point && cell[point] == '.') {
    if (with_point.empty()) with_point = cell;
    with_point.insert(point, 1, '0');
    cell = with_point;
  }
  const DecimalNumber x = decimal_number(cell);
  if (x.kind != DecimalNumber::Kind::number || x.size != cell.size()) return {};
  return x.value;
}

std::string unit_in_words(std::string_view cell) {
  const std::string_view bare = trimmed(cell, " \t\"'()[]");
  std::string lower(bare);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  constexpr std::pair<std::string_view, std::string_view> words[] = {
      {"second", "s"}, {"seconds", "s"}, {"sec", "s"}, {"millisecond", "ms"}, {"microsecond", "us"},
      {"volt", "V"},   {"volts", "V"},   {"v", "V"},   {"mv", "mV"},          {"millivolt", "mV"}};
  for (const auto& [word, unit] : words)
    if (lower == word) return std::string(unit);
  const std::string unit = plain_spelling(bare);
  return !unit.empty() && unit_of(unit) ? unit : std::string();
}

Heading heading_of(std::string_view cell) {
  const std::size_t open = cell.find_last_of("[(");
  if (open != std::string_view::npos && open > 0 && (cell.back() == ']' || cell.back() == ')'))
    if (std::string unit = unit_in_words(cell.substr(open)); !unit.empty())
      return {std::string(trimmed(cell.substr(0, open))), std::move(unit)};
  // "u_ab_V"; but "U_A" is no current, for what is recorded here are times and voltages.
  const std::string_view without = without_unit(cell);
  if (without.size() < cell.size() && !without.empty())
    if (std::string unit = unit_in_words(cell.substr(without.size() + 1)); is_time_or_voltage(unit))
      return {std::string(without), std::move(unit)};
  return {std::string(cell), {}};
}

}  // namespace text
