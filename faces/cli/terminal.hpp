// SPDX-License-Identifier: Apache-2.0
// Prints the program's texts and queries the terminal.
#pragma once
#include <cstdio>
#include <string>
#include <string_view>

#include "faces/cli/exit_code.hpp"
#include "faces/cli/rooms.hpp"
#include "sixstep/base/problem.hpp"

namespace cli {

/// Prints the text. If standard output fails, the error is kept and later text is discarded.
void print(std::string_view text, std::FILE* to = stdout);
/// Whether standard output has failed.
bool unheard();
/// The last call of every command. A failed standard output is reported and gives `bad_input`. If the reader
/// has closed a pipe, nothing is reported, and `reader_gone` replaces an `ok`.
Exit exit_after_printing(Exit exit);

/// Prints one complaint per line on standard error.
void complain(const base::Problems& problems);
/// Reports bad input. After an interrupt during a wait for the other end of a pipe, nothing is reported.
Exit refused(const base::Problems& problems);

/// Whether the stream is a terminal and NO_COLOR is not set (no-color.org).
bool may_colour(std::FILE* stream);

/// Number of the terminal's columns. 0 if the stream is no terminal, or a terminal that cannot move to the
/// line's beginning.
std::size_t terminal_width(std::FILE* stream);

/// Makes a closed pipe, a file at its size limit and a closed stream (>&-) cause write errors instead of the
/// program's end. No file then gets a standard stream's number.
void take_write_errors();

}  // namespace cli
