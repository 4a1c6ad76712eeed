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

/// Prints the text. After a failure of standard output, later text is discarded.
void print(std::string_view text, std::FILE* to = stdout);
/// Whether standard output has failed.
bool unheard();
/// The last call of every command. If standard output has failed, reports the error and returns `bad_input`.
/// If the reader has closed a pipe, reports nothing, and returns `reader_gone` instead of `ok`.
Exit exit_after_printing(Exit exit);

/// Prints one problem per line on standard error.
void complain(const base::Problems& problems);
/// Prints the problems and returns `bad_input`. After an interrupt, for example while waiting for a pipe, prints
/// nothing and returns the interrupt's exit code.
Exit refused(const base::Problems& problems);

/// Whether the stream is a terminal and NO_COLOR is not set (no-color.org).
bool may_colour(std::FILE* stream);

/// Number of the terminal's columns. 0 if the stream is no terminal, or if its cursor cannot return to the
/// beginning of the line.
std::size_t terminal_width(std::FILE* stream);

/// After this call, a closed pipe, a file at its size limit and a closed stream (>&-) cause write errors
/// instead of ending the program. No file gets the number of a standard stream.
void take_write_errors();

}  // namespace cli
