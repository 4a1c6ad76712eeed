// SPDX-License-Identifier: Apache-2.0
// Decides whether commas and points in a table's numbers are decimal marks or separate thousands.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/base/problem.hpp"
#include "text/rooms.hpp"

namespace text {

/// Whether a mark may separate thousands, as in "1,025" and "-2,940". There is one mark before exactly three
/// digits; one to three digits precede it, of which the first is not 0.
bool may_part_thousands(std::string_view number, char mark);

/// Collects the cells that are numbers. A table is ambiguous if it has both marks, or if each of its marks
/// could separate thousands.
class DecimalMarks {
 public:
  void see(std::size_t line, std::size_t column, std::string_view cell);
  /// The Problem of an ambiguous table; `file` is the name for messages. A semicolon between cells indicates
  /// a country with a decimal comma, where points may separate thousands.
  std::optional<base::Problem> doubt(const std::string& file, char separator) const;

 private:
  struct Cell {
    std::size_t line = 0;
    std::string text;
  };
  /// The cells of one column that contain one kind of mark.
  struct Marked {
    std::optional<Cell> first;
    bool in_thousands = true;  ///< true: the mark may separate thousands in each of these cells
  };
  struct Column {
    Marked comma, point;
    std::optional<Cell> hundreds;  ///< a number from 100 to 999 without a mark
    bool bare_thousands = false;   ///< true: the column has a number of 1000 or more without a mark
  };
  const Cell* first_of(Marked Column::*mark) const;
  std::optional<base::Problem> thousands(const std::string& file, Marked Column::*mark, char c,
                                         bool decimal_point) const;

  std::vector<Column> columns_;
};

}  // namespace text
