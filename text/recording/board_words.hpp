// SPDX-License-Identifier: Apache-2.0
// Prints a board's own messages in a log: remarks between the rows, missed periods, faults.
#pragma once
#include "text/recording/recording.hpp"

namespace text {

Notes what_the_board_says(const Recording& recording);

/// Whether what_the_board_says() evaluates this column. Then no note says that a simulation does not have the
/// column.
bool is_the_boards_word(const RecordedColumn& column);

}  // namespace text
