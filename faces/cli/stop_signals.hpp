// SPDX-License-Identifier: Apache-2.0
// Handles termination signals: Ctrl-C, SIGTERM, a closed terminal, a limit of processor time.
#pragma once
#include <string>

#include "faces/cli/exit_code.hpp"

namespace cli {

/// Makes such a signal remove temporary files before it ends the program at once.
void take_stop_signals();
/// Makes such a signal stop runs; a second Ctrl-C, SIGTERM or SIGQUIT ends the program at once. Used by every
/// verb that must clean up more than temporary files.
void catch_interrupts();

bool interrupted();
/// The exit code after a signal: 128 plus the signal's number, as in shells.
Exit exit_of_interrupt();

/// Prints the state of an interrupted verb on standard error.
void tell_stop(const std::string& line);
/// Tells exit_after_stop() that standard output has reported the interrupt.
void stop_is_told();
/// Reports an interrupt of work that leaves no result. `kept` names anything that the work does leave.
Exit told_interrupted(const std::string& what, const std::string& kept = "");
/// The exit code of work that continues until it is interrupted: returns `exit` unchanged.
Exit ended_as_asked(Exit exit);

/// The exit code of a verb that has returned. After an interrupt it is never success, because the result may
/// be incomplete. Also reports the interrupt if the verb has not.
Exit exit_after_stop(Exit exit);

}  // namespace cli
