// SPDX-License-Identifier: Apache-2.0
// Tables of numbers as oscilloscopes, logic analyzers and loggers export them: lines of preamble, headings
// with units or a line of units below them, then rows.
#pragma once
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/base/result.hpp"
#include "text/rooms.hpp"

namespace text {

struct RecordedColumn {
  std::string name;  ///< the heading without its unit; "column 2" where there is none
  std::string unit;  ///< as units.hpp spells it; empty where there is none
  std::vector<double> values;
  /// The first cell that is no number. Columns that nobody asks for may hold what they like.
  std::size_t wrong_line = 0;
  std::string wrong_cell;
};

struct Recording {
  std::string name;            ///< of the file, for messages
  std::size_t first_line = 1;  ///< of the rows
  std::vector<RecordedColumn> columns;

  std::size_t rows() const { return columns.front().values.size(); }
};

/// Cells are parted by ';' or a tab (then a comma may stand for the decimal point), ',' or blanks. A line that
/// begins with '#' or '%' is a remark.
base::Result<Recording> read_recording(const std::string& name, std::string_view text);

/// Letters and digits in lower case: "U_ab" is "uab".
std::string bare_name(std::string_view heading);

/// The column whose bare name is one of these; null where there is none.
const RecordedColumn* find_column(const Recording& recording, std::initializer_list<std::string_view> names);

/// The column with that heading; a Problem that says which there are.
base::Result<const RecordedColumn*> column_called(const Recording& recording, const std::string& heading);

/// Its values in that unit; as they stand where it has none.
base::Result<std::vector<double>> values_of(const Recording& recording, const RecordedColumn& column,
                                            std::string_view unit);

/// By its heading or its unit; the first of several columns without headings. Null where there is none.
const RecordedColumn* time_column(const Recording& recording);

/// In s, of that column; or so far apart, where an interval is given.
base::Result<std::vector<double>> times_of(const Recording& recording, std::optional<double> interval_s);

/// "hall1, hall2, u_ab": what messages say there is.
std::string headings_of(const Recording& recording);

}  // namespace text
