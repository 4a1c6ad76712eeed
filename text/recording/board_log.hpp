// SPDX-License-Identifier: Apache-2.0
// Reads a recording of a running drive as a trace: the log of a board, the log of another maker's drive, or
// an oscilloscope's record. Headings are the names of a trace's columns with units of the same kind ("t
// [us]", "i_m [mA]", "speed [rad/s]"), or the headings of a known tool (known_logs.hpp). Otherwise formulas
// name the columns.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/base/result.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "text/recording/columns.hpp"
#include "text/rooms.hpp"

namespace text {

/// Columns that the user names, in addition to the headings or in place of them.
struct LogColumns {
  std::vector<std::string>
      formulas;  ///< see column_formula.hpp; if given, only their columns and the time are read
  std::optional<double> interval_s;  ///< interval of the rows, if no column is a time
  std::optional<int> pole_pairs{};   ///< pole pairs of the motor, which convert electrical speeds
  bool field_oriented =
      false;  ///< true: the simulated drive is field-oriented, which selects other columns of known logs
  std::optional<int> esc{};  ///< number of the drive to read in a log of several drives
};

struct BoardLog {
  study::Trace trace;
  std::string
      recognised;  ///< "a VESC Tool log: time = ms_today/1000, .."; empty: read by its headings or by formulas
  std::vector<NotUsed> not_used;
  Notes notes;
};

/// Reads a log from its last headings on, where the board last started; an incomplete last line is left out.
/// Without formulas the columns of a known log are converted from the tool's units and frames.
/// Problems: no time, no column of a trace, an unknown unit, a cell that is not a number, a time that does
/// not rise.
base::Result<BoardLog> read_board_log(const std::string& name, std::string_view bytes,
                                      const LogColumns& wanted = {});

}  // namespace text
