// SPDX-License-Identifier: Apache-2.0
// Reads tables of numbers from oscilloscopes, logic analyzers, drives, simulators and loggers. A table has a
// preamble, headings with units or a line of units below them, then rows. The program reads every table of
// numbers with these functions.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sixstep/base/result.hpp"
#include "text/recording/preamble.hpp"
#include "text/rooms.hpp"

namespace text {

/// A cell that is not a number.
struct BadCell {
  std::size_t line = 0;
  std::string cell;
};

struct RecordedColumn {
  std::string heading;         ///< heading as in the file
  std::string name;            ///< unique, without its unit; "column 2" without a heading
  std::string bare;            ///< bare_name() of `name`; two columns may have the same bare name
  std::string unit;            ///< unit in the spelling of units.hpp; empty: none
  std::string odd_unit;        ///< the word in the place of the unit if that word is no unit
  bool letter = false;         ///< true: the unit may be a part of the name (Heading::letter)
  std::vector<double> values;  ///< values in the unit without its power of ten: in V for mV
  std::vector<BadCell> bad;    ///< the first few bad cells; an unused column may contain anything
  std::size_t bad_cells = 0;   ///< number of bad cells
  bool filled = false;         ///< true: at least one cell is not empty

  bool has_numbers() const { return bad_cells < values.size(); }
};

/// Messages about an accepted file: unused parts with the reason, and assumptions.
using Notes = std::vector<std::string>;

/// A line between the file's rows that begins with '#' or '%'.
struct Remark {
  std::string text;       ///< text without '#' or '%'
  std::size_t line = 0;   ///< line of its first occurrence
  std::size_t times = 1;  ///< number of occurrences
};
/// Largest number of different remarks that are kept.
constexpr std::size_t most_remarks = 8;

struct Recording {
  std::string name;  ///< name of the file, for messages
  std::vector<RecordedColumn> columns;
  std::optional<RowClock> clock;  ///< interval and start of the rows, from the preamble
  bool has_headings = false;
  std::vector<std::pair<std::size_t, std::size_t>> lines{};  ///< index of a row and its line in the file, for
                                                             ///< the first row and for each row after skipped
                                                             ///< lines
  std::vector<Remark> remarks{};                             ///< remarks below the first row
  Notes notes;

  std::size_t rows() const { return columns.front().values.size(); }
  std::size_t line_of(std::size_t row) const;
};

/// A Problem whose text begins with the file's name: "scope.csv: limit; cure".
base::Problem of_recording(const Recording& recording, std::string limit, std::string cure);

/// Selects the rows that are read.
enum class RowsFrom {
  first,      ///< all rows
  last_start  ///< rows from the board's last start, at its last headings, to the last complete line
};

/// Reads a table. Cells are separated by ',' or by ';', a tab or blanks. If they are not separated by ',', a
/// comma may be the decimal point. A line that begins with '#' or '%' is a remark. If an instrument writes
/// keys and values in the cells next to the rows, only the rows are read.
base::Result<Recording> read_recording(const std::string& name, std::string_view bytes,
                                       RowsFrom from = RowsFrom::first);

}  // namespace text
