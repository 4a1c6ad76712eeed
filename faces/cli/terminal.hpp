// SPDX-License-Identifier: Apache-2.0
// What the program says, and what the terminal may be asked.
#pragma once
#include <cstdio>
#include <string_view>

#include "faces/cli/exit_code.hpp"
#include "faces/cli/rooms.hpp"
#include "sixstep/base/problem.hpp"

namespace cli {

void print(std::string_view text, std::FILE* to = stdout);

/// One complaint a line, on the error stream.
void complain(const base::Problems& problems);
/// Bad input, told.
Exit refused(const base::Problems& problems);

/// A terminal, and NO_COLOR not set (no-color.org).
bool may_colour(std::FILE* stream);

/// Columns of the terminal; 0 where the stream is none, or one that cannot go back to the line's begin.
std::size_t terminal_width(std::FILE* stream);

/// A pipe's reader that has gone and a file that may not grow are errors of a write, not the program's end.
void take_write_errors();

/// From here on Ctrl-C and SIGTERM ask runs to end instead of ending the program; a second time ends it at
/// once.
void catch_interrupts();
bool interrupted();
/// 130 after Ctrl-C, 143 after SIGTERM.
Exit exit_of_interrupt();

}  // namespace cli
