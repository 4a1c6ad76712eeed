// SPDX-License-Identifier: Apache-2.0
// What a board sent over its serial line while it ran, as a trace: a table whose headings are a trace's columns with units of the same
// kind ("t [us]", "i_m [mA]", "speed [rad/s]").
#pragma once
#include <string>
#include <string_view>

#include "sixstep/base/result.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "text/rooms.hpp"

namespace text {

/// Where the board began anew, from its last headings on; a line that was cut short at the end is left out. Columns that no trace has are
/// passed over. Problems: no time, no column of a trace, a cell that is no number, a time that does not rise.
base::Result<study::Trace> read_board_log(const std::string& name, std::string_view text);

}  // namespace text
