// SPDX-License-Identifier: Apache-2.0
#include "text/recording/decimal_marks.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "text/keys/bounded.hpp"

namespace text {
namespace {

constexpr std::string_view every_digit = "0123456789";
constexpr std::size_t longest_quoted = 40;

std::string_view without_sign(std::string_view number) {
  if (number.starts_with('-') || number.starts_with('+')) number.remove_prefix(1);
  return number;
}

base::Problem in_doubt(const std::string& file, std::size_t line, std::string limit) {
  return bounded(
      {.where = fmt::format("{}:{}:", file, line),
       .value = "",
       .limit = std::move(limit),
       .cure =
           "write thousands without a separator, for example 2940, and use one decimal mark, or remove the column"});
}

}  // namespace

bool may_part_thousands(std::string_view number, char mark) {
  number = without_sign(number);
  const std::size_t at = number.find(mark);
  return at >= 1 && at <= 3 && number[0] != '0' && number.size() == at + 4 &&
         number.find_first_not_of(every_digit) == at &&
         number.find_first_not_of(every_digit, at + 1) == std::string_view::npos;
}

void DecimalMarks::see(std::size_t line, std::size_t column, std::string_view cell) {
  if (columns_.size() <= column) columns_.resize(column + 1);
  Column& of = columns_[column];
  const std::size_t at = cell.find_first_of(",.");
  if (at == std::string_view::npos) {
    const std::string_view digits = without_sign(cell);
    of.bare_thousands |= digits.size() > 3;
    if (!of.hundreds && digits.size() == 3 && digits[0] != '0') of.hundreds = {line, std::string(cell)};
    return;
  }
  Marked& marked = cell[at] == ',' ? of.comma : of.point;
  if (!marked.first) marked.first = {line, std::string(cell.substr(0, longest_quoted))};
  marked.in_thousands = marked.in_thousands && may_part_thousands(cell, cell[at]);
}

const DecimalMarks::Cell* DecimalMarks::first_of(Marked Column::*mark) const {
  const Cell* found = nullptr;
  for (const Column& column : columns_)
    if (const std::optional<Cell>& cell = (column.*mark).first; cell && (!found || cell->line < found->line))
      found = &*cell;
  return found;
}

/// One cell that can only be a decimal fraction determines the mark of the whole file. A column with numbers
/// of 1000 and more without a mark determines only its own mark. `decimal_point`: the mark is decimal unless
/// a column has a number such as 942 in addition to 1.025.
std::optional<base::Problem> DecimalMarks::thousands(const std::string& file, Marked Column::*mark, char c,
                                                     bool decimal_point) const {
  const auto settles = [&](const Column& column) {
    return (column.*mark).first && !(column.*mark).in_thousands;
  };
  if (std::any_of(columns_.begin(), columns_.end(), settles)) return {};
  for (const Column& column : columns_) {
    const std::optional<Cell>& first = (column.*mark).first;
    if (!first || column.bare_thousands || (decimal_point && !column.hundreds)) continue;
    std::string whole = first->text;
    std::erase(whole, c);
    std::string fraction = first->text;
    std::replace(fraction.begin(), fraction.end(), ',', '.');
    const std::string beside =
        column.hundreds ? fmt::format(" beside {} in line {}", column.hundreds->text, column.hundreds->line)
                        : "";
    return in_doubt(
        file, first->line,
        fmt::format("contains {}{}, which may mean {} or {}", first->text, beside, whole, fraction));
  }
  return {};
}

std::optional<base::Problem> DecimalMarks::doubt(const std::string& file, char separator) const {
  const Cell *const comma = first_of(&Column::comma), *const point = first_of(&Column::point);
  if (comma && point) {
    const Cell &late = comma->line < point->line ? *point : *comma,
               &early = comma->line < point->line ? *comma : *point;
    return in_doubt(file, late.line,
                    fmt::format("contains {}, and line {} contains {}: either mark may be the decimal mark",
                                late.text, early.line, early.text));
  }
  if (comma) return thousands(file, &Column::comma, ',', false);
  return thousands(file, &Column::point, '.', separator != ';');
}

}  // namespace text
