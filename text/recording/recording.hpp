// SPDX-License-Identifier: Apache-2.0
// Tables of numbers as oscilloscopes, logic analyzers, drives, simulators and loggers export them: lines of preamble, headings with
// units or a line of units below them, then rows. Every table of numbers that the program reads is read here.
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
  std::string heading;         ///< as it stands in the file
  std::string name;            ///< without its unit, and no other column's; "column 2" where there is none
  std::string bare;            ///< bare_name() of it, which two columns may have
  std::string unit;            ///< as units.hpp spells it; empty where there is none
  std::string odd_unit;        ///< what stands in the place of the unit and is none
  bool letter = false;         ///< the unit may be a part of the name: Heading
  std::vector<double> values;  ///< in the unit without its power of ten: in V where it is mV
  std::vector<BadCell> bad;    ///< the first of them; columns that nobody asks for may hold what they like
  std::size_t bad_cells = 0;   ///< how many there are
  bool filled = false;         ///< some cell is not empty

  bool has_numbers() const { return bad_cells < values.size(); }
};

/// What a reader has to say of a file that it took: what it did not use, and why; what it took for what.
using Notes = std::vector<std::string>;

/// A line of the file between its rows that begins with '#' or '%'.
struct Remark {
  std::string text;       ///< without that mark
  std::size_t line = 0;   ///< of the first that says so
  std::size_t times = 1;  ///< how many do
};
/// Of different ones.
constexpr std::size_t most_remarks = 8;

struct Recording {
  std::string name;  ///< of the file, for messages
  std::vector<RecordedColumn> columns;
  std::optional<RowClock> clock;  ///< what the preamble says
  bool has_headings = false;
  std::vector<std::pair<std::size_t, std::size_t>> lines{};  ///< row and line, wherever lines are skipped
  std::vector<Remark> remarks{};                             ///< below the first row
  Notes notes;

  std::size_t rows() const { return columns.front().values.size(); }
  std::size_t line_of(std::size_t row) const;
};

/// "scope.csv: limit; cure"
base::Problem of_recording(const Recording& recording, std::string limit, std::string cure);

/// Which of the rows count.
enum class RowsFrom {
  first,      ///< all
  last_start  ///< where a board began anew, from its last headings on, and to the last line that is whole
};

/// Cells are parted by ';', a tab or blanks (then a comma may stand for the decimal point) or ','. A line that begins with '#' or '%'
/// is a remark. Of instruments that write key and value beside the rows, the rows are taken.
base::Result<Recording> read_recording(const std::string& name, std::string_view bytes,
                                       RowsFrom from = RowsFrom::first);

}  // namespace text
