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

/// From here on Ctrl-C asks runs to end instead of ending the program.
void catch_interrupts();
bool interrupted();

}  // namespace cli
