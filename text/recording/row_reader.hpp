// SPDX-License-Identifier: Apache-2.0
// Reads the lines of a recording one by one.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "text/recording/decimal_marks.hpp"
#include "text/recording/recording.hpp"

namespace text {

/// The position of the rows in a table that has other cells next to the rows.
struct RowsBeside {
  char separator = 0;
  std::size_t cells = 0;  ///< number of cells before the row's own first cell
};

/// Recognises a table in which most lines begin with the same number of empty cells and then a number: after
/// "Record Length,2500,,-0.02,3.78" follows ",,,-0.0199,3.77".
std::optional<RowsBeside> rows_beside(std::string_view text);

class RowReader {
 public:
  /// `line`: number of lines of the file before the first line that is passed to line().
  RowReader(std::string name, std::size_t line, std::optional<RowsBeside> beside);

  /// Reads the next line. Returns false if the rest is not read, because the text is no table or too long.
  bool line(std::string_view text);
  base::Result<Recording> result();

 private:
  bool begins_rows(std::string_view text);
  bool row_beside(std::string_view text);
  void begin(std::size_t cells);
  void remark(std::string_view text);
  void row(const std::vector<std::string_view>& cells);
  std::optional<base::Problem> wrong_cells() const;

  Recording out_;
  std::optional<RowsBeside> beside_;
  std::vector<std::string> above_, remarks_;
  char separator_ = 0;
  std::size_t number_, values_ = 0, names_ = 0;
  std::vector<int> tens_;  ///< powers of ten of the columns' units
  DecimalMarks marks_;
  std::size_t wide_line_ = 0, wide_cells_ = 0, first_cells_ = 0, first_line_ = 0;
  bool has_point_ = false, has_leading_zero_ = false;
};

}  // namespace text
