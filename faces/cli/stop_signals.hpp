// SPDX-License-Identifier: Apache-2.0
// Signals that ask the program to end: Ctrl-C, SIGTERM, a terminal that has gone, a limit of processor time.
#pragma once
#include <string>

#include "faces/cli/exit_code.hpp"

namespace cli {

/// From here on such a signal leaves no temporary file behind; it still ends the program at once.
void take_stop_signals();
/// From here on it asks runs to end instead; Ctrl-C, SIGTERM or SIGQUIT a second time end the program at once. For every verb that
/// has more to put in order than temporary files.
void catch_interrupts();

bool interrupted();
/// 128 and the signal's number, as shells count.
Exit exit_of_interrupt();

/// Says on standard error what a verb that was told to end has come to.
void tell_stop(const std::string& line);
/// Standard output says it already.
void stop_is_told();
/// Of work that leaves nothing behind where it is cut short, which is told; `kept` says what it does leave.
Exit told_interrupted(const std::string& what, const std::string& kept = "");
/// Of work that goes on until it is told to end: `exit` stands.
Exit ended_as_asked(Exit exit);

/// The exit code of a verb that has come back. One that was told to end never says that all went well, whatever it found: its
/// answer may lack what it left out. A verb that has said nothing of it is spoken for.
Exit exit_after_stop(Exit exit);

}  // namespace cli
