// SPDX-License-Identifier: Apache-2.0
// What the program says, and what the terminal may be asked.
#pragma once
#include <cstdio>
#include <string>
#include <string_view>

#include "faces/cli/exit_code.hpp"
#include "faces/cli/rooms.hpp"
#include "sixstep/base/problem.hpp"

namespace cli {

/// What standard output could not take is remembered, and nothing more is sent there.
void print(std::string_view text, std::FILE* to = stdout);
/// Standard output takes nothing more.
bool unheard();
/// The last word of every command: what standard output could not take is told and is bad input; a reader who
/// has seen enough is told nothing, and `reader_gone` stands for an `ok` that nobody heard.
Exit exit_after_printing(Exit exit);

/// One complaint a line, on the error stream.
void complain(const base::Problems& problems);
/// Bad input, told; but who was told to end while waiting for the other end of a pipe has nothing to complain
/// of.
Exit refused(const base::Problems& problems);

/// A terminal, and NO_COLOR not set (no-color.org).
bool may_colour(std::FILE* stream);

/// Columns of the terminal; 0 where the stream is none, or one that cannot go back to the line's begin.
std::size_t terminal_width(std::FILE* stream);

/// A pipe's reader that has gone, a file that may not grow and a stream that was closed (>&-) are errors of a
/// write, not the program's end, and no file takes the stream's place.
void take_write_errors();

}  // namespace cli
