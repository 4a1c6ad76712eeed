// SPDX-License-Identifier: Apache-2.0
// What a board says of itself beside the numbers of a run: remarks between the rows, periods that it missed, faults.
#pragma once
#include "text/recording/recording.hpp"

namespace text {

Notes what_the_board_says(const Recording& recording);

/// Whether its numbers are told there, so that nobody has to be told that a simulation has no such column.
bool is_the_boards_word(const RecordedColumn& column);

}  // namespace text
