// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string_view>

#include "faces/cli/rooms.hpp"
#include "sixstep/study/measure/outcome.hpp"

namespace cli {

/// The program's exit code. For several runs, it is the exit code of the gravest result.
enum class Exit : int {
  ok = 0,         ///< all requirements hold
  failed = 1,     ///< a requirement failed
  bad_input = 2,  ///< also: a file cannot be read or written
  fault = 3,      ///< a fault stopped a run or its drive
  internal = 4,   ///< an error of the program itself
  // Exit codes after signals, as in shells: 128 plus the signal's number.
  hung_up = 129,      ///< SIGHUP: the terminal was closed
  interrupted = 130,  ///< SIGINT: the user pressed Ctrl-C
  quit = 131,         ///< SIGQUIT
  reader_gone = 141,  ///< SIGPIPE: the reader closed the pipe
  terminated = 143,   ///< SIGTERM
  out_of_time = 152   ///< SIGXCPU
};

struct ExitMeaning {
  Exit code;
  std::string_view meaning;
};

/// The meaning of each exit code, for help and manual.
inline constexpr ExitMeaning exit_meanings[] = {
    {Exit::ok, "all requirements hold"},
    {Exit::failed, "a requirement failed"},
    {Exit::bad_input, "bad input"},
    {Exit::fault, "a fault stopped a run"},
    {Exit::internal, "internal error"},
    {Exit::hung_up, "ended by SIGHUP when its terminal closed"},
    {Exit::interrupted, "interrupted by Ctrl-C"},
    {Exit::quit, "ended by SIGQUIT"},
    {Exit::reader_gone, "the reader of the pipe has ended"},
    {Exit::terminated, "ended by SIGTERM"},
    {Exit::out_of_time, "ended by SIGXCPU at the limit of processor time"},
};

/// Exit code of a run that reached its end or a fault.
inline Exit exit_of(const study::Outcome& outcome) {
  if (outcome.fault) return Exit::fault;
  return outcome.passed() ? Exit::ok : Exit::failed;
}

inline Exit graver(Exit a, Exit b) { return static_cast<int>(a) > static_cast<int>(b) ? a : b; }

}  // namespace cli
