// SPDX-License-Identifier: Apache-2.0
// Handles termination signals: Ctrl-C, SIGTERM, a closed terminal, a limit of processor time.
#pragma once
#include <string>

#include "faces/cli/exit_code.hpp"

namespace cli {

/// Lets a termination signal remove temporary files and end the program at once.
void take_stop_signals();
/// Lets a termination signal stop the runs; a second Ctrl-C, SIGTERM or SIGQUIT ends the program at once. A
/// verb calls this function if it must remove more than temporary files.
void catch_interrupts();

bool interrupted();
/// The exit code after a signal: 128 plus the signal's number, as in shells.
Exit exit_of_interrupt();

/// Prints the state of an interrupted verb on standard error.
void tell_stop(const std::string& line);
/// Records that standard output has reported the interrupt, for exit_after_stop().
void stop_is_told();
/// Reports an interrupt of work without a result. `kept` names the files that remain.
Exit told_interrupted(const std::string& what, const std::string& kept = "");
/// The exit code of work that only an interrupt can end (--watch): returns `exit` unchanged.
Exit ended_as_asked(Exit exit);

/// The exit code of a verb that has returned. After an interrupt it is never success, because the result may
/// be incomplete. Reports the interrupt if the verb has not reported it.
Exit exit_after_stop(Exit exit);

}  // namespace cli
