// SPDX-License-Identifier: Apache-2.0
// Recognises the logs of drive tools by their headings. known_logs.cpp contains the table.
// docs/howto/compare-a-log.md has a public source for each heading and each frame.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sixstep/base/result.hpp"
#include "text/recording/board_log.hpp"
#include "text/rooms.hpp"

namespace text {

struct KnownLog {
  std::string name;  ///< "a VESC Tool log"
  std::vector<std::string>
      formulas;  ///< formulas of the columns (column_formula.hpp), with the time's formula if the log has a time
  std::vector<NotUsed>
      not_used;      ///< columns with another meaning than the simulation's columns, with the reason
  std::string escs;  ///< column with the number of the ESC; empty: none
};

/// The log's kind, and its columns in a trace's quantities. Columns of the drive's axes are read for a
/// field-oriented drive only. Empty: no known log. Problems:
/// - a log of several ESCs, and `wanted` has no ESC number;
/// - a log without time, and `wanted` has no interval;
/// - a log without any column that a simulation has.
base::Result<std::optional<KnownLog>> known_log(const Recording& recording, std::string_view bytes,
                                                const LogColumns& wanted);

/// The rows of one ESC. Problems: the rows of several ESCs without a number in `esc`, or a number that no row
/// has.
base::Result<Recording> rows_of_esc(const Recording& recording, const std::string& heading,
                                    std::optional<int> esc);

}  // namespace text
