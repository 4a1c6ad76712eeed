// SPDX-License-Identifier: Apache-2.0
// What was recorded of a drive while it ran, as a trace: the log that a board sent, that of another maker's drive, or an oscilloscope's
// record. Headings are those of a trace's columns with units of the same kind ("t [us]", "i_m [mA]", "speed [rad/s]"), or formulas say which
// column is which.
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

/// What the headings do not say, or say otherwise.
struct LogColumns {
  std::vector<std::string>
      formulas;  ///< column_formula.hpp; where there are any, no other column is looked at but the time's
  std::optional<double> interval_s;  ///< of the rows, where none is a time
  std::optional<int> pole_pairs{};   ///< of the motor: electrical speeds convert by them
};

struct BoardLog {
  study::Trace trace;
  std::vector<NotUsed> not_used;
  Notes notes;
};

/// Where the board began anew, from its last headings on; a line that was cut short at the end is left out. Problems: no time, no column of
/// a trace, a unit that is none, a cell that is not a number, a time that does not rise.
base::Result<BoardLog> read_board_log(const std::string& name, std::string_view bytes,
                                      const LogColumns& wanted = {});

}  // namespace text
