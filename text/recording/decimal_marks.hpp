// SPDX-License-Identifier: Apache-2.0
// Whether the commas and the points in a table's numbers are decimal marks, or part thousands.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/base/problem.hpp"
#include "text/rooms.hpp"

namespace text {

/// "1,025" and "-2,940": one mark before exactly three digits, and before it one to three that do not begin with 0.
bool may_part_thousands(std::string_view number, char mark);

/// Looks at each cell that is a number. In doubt are a table with both marks, and one whose only mark appears as if it parted thousands.
class DecimalMarks {
 public:
  void see(std::size_t line, std::size_t column, std::string_view cell);
  /// Of the file that is called so. Semicolons between its cells come from a country that writes a decimal comma, and may part thousands
  /// by points.
  std::optional<base::Problem> doubt(const std::string& file, char separator) const;

 private:
  struct Cell {
    std::size_t line = 0;
    std::string text;
  };
  /// What one column has of one mark.
  struct Marked {
    std::optional<Cell> first;
    bool in_thousands = true;  ///< each of them may part thousands
  };
  struct Column {
    Marked comma, point;
    std::optional<Cell> hundreds;  ///< 100 to 999 without a mark
    bool bare_thousands = false;   ///< a number of 1000 and more without a mark
  };
  const Cell* first_of(Marked Column::*mark) const;
  std::optional<base::Problem> thousands(const std::string& file, Marked Column::*mark, char c,
                                         bool decimal_point) const;

  std::vector<Column> columns_;
};

}  // namespace text
