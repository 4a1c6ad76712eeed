// SPDX-License-Identifier: Apache-2.0
// Prints a board's own messages with the numbers of a run: remarks between the rows, missed periods, faults.
#pragma once
#include "text/recording/recording.hpp"

namespace text {

Notes what_the_board_says(const Recording& recording);

/// Whether what_the_board_says() covers this column, so that it needs no note that a simulation lacks it.
bool is_the_boards_word(const RecordedColumn& column);

}  // namespace text
