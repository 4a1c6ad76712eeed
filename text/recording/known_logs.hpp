// SPDX-License-Identifier: Apache-2.0
// Recognises the logs of drive tools by their headings. The table stands in known_logs.cpp;
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
  std::string name;                   ///< "a VESC Tool log"
  std::vector<std::string> formulas;  ///< see column_formula.hpp; the time's too if the log has a time
  std::vector<NotUsed> not_used;  ///< columns that mean something else than the simulation's, with the reason
  std::string escs;               ///< column with the number of the ESC; empty: none
};

/// The log's kind, and its columns in a trace's quantities. Columns of the drive's axes are taken for a
/// field-oriented drive only. Empty: no known log. Problems: a log of several ESCs without the number of one,
/// a log without time and without interval, a log without any column that a simulation has.
base::Result<std::optional<KnownLog>> known_log(const Recording& recording, std::string_view bytes,
                                                const LogColumns& wanted);

/// The rows of one ESC. Problems: rows of several without a number, a number that no row has.
base::Result<Recording> rows_of_esc(const Recording& recording, const std::string& heading,
                                    std::optional<int> esc);

}  // namespace text
