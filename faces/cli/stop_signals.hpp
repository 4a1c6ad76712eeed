// SPDX-License-Identifier: Apache-2.0
// Handles signals that ask the program to end: Ctrl-C, SIGTERM, a closed terminal, a limit of processor time.
#pragma once
#include <string>

#include "faces/cli/exit_code.hpp"

namespace cli {

/// From now on such a signal also removes temporary files; it still ends the program at once.
void take_stop_signals();
/// From now on such a signal asks runs to end; a second Ctrl-C, SIGTERM or SIGQUIT ends the program at once. For
/// every verb that must clean up more than temporary files.
void catch_interrupts();

bool interrupted();
/// 128 and the signal's number, as shells count.
Exit exit_of_interrupt();

/// Prints the state of an interrupted verb on standard error.
void tell_stop(const std::string& line);
/// Tells exit_after_stop() that standard output has reported the interrupt.
void stop_is_told();
/// For work that leaves nothing when it is interrupted: prints that. `kept` names anything that it does leave.
Exit told_interrupted(const std::string& what, const std::string& kept = "");
/// For work that continues until it is interrupted: `exit` stays the exit code.
Exit ended_as_asked(Exit exit);

/// The exit code of a verb that has returned. An interrupted verb never returns success, because its result may
/// be incomplete. If the verb has not reported the interrupt, it is reported here.
Exit exit_after_stop(Exit exit);

}  // namespace cli
