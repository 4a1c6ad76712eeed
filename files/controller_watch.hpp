// SPDX-License-Identifier: Apache-2.0
// Code of others runs in this program. What is known of it from outside at every moment: which controller a thread is inside of, at
// which step of which run; so that whatever ends the program there is told by name. All of it lies in plain memory, and what reads it
// may be a signal handler.
//
// In the program, and not in a process of its own: a step is called some 30 000 times in a simulated second, and the way to another
// process and back costs more than all the rest of a control period.
#pragma once
#include <atomic>
#include <cstdint>
#include <string>

namespace files {

enum class ControllerPlace : std::uint8_t { outside, loading, design, start, step, hall };

/// A thread that calls controllers.
struct ControllerThread {
  std::atomic<long> thread{0};       ///< its number; 0: nobody's
  const char* controller = nullptr;  ///< the file's path, which stays
  std::atomic<ControllerPlace> place{ControllerPlace::outside};
  std::atomic<std::uint64_t> calls{0}, calls_at_stop{0};
  std::uint64_t steps = 0;  ///< of the run that it is at
  double period_s = 0.0;
  std::int64_t run = -1;  ///< of a plan; -1: of none
};

/// That of the thread that asks. It is watched from here on: its crashes, and its end.
ControllerThread& controller_thread();

/// Whose code will be loaded; the name stays. The first call has the program's end and its crashes looked at.
void watch_controllers(const char* path);

/// Which run of its plan this thread makes next.
void controllers_make_run(std::uint64_t number);
/// Where a run is noted that ended the program, a line each: number, tab, what happened. Empty: nowhere.
void note_stopped_runs_in(const std::string& path);

/// The program's own code is at work: who calls exit() until `controllers_are_done()` is no one of ours.
void controllers_may_run();
void controllers_are_done();

/// The last words on this thread's controller, in half a sentence. Temporary files are removed, the run is noted, and the program ends
/// with exit code 3, as of a fault.
[[noreturn]] void end_by_controller(const ControllerThread& at, const char* what);

// For a handler of signals that ask the program to end.
/// Which call each thread is in now.
void mark_controller_calls();
/// Those that are in the same call still are told, and their runs noted.
void tell_controllers_that_do_not_come_back();
bool controllers_are_watched();

}  // namespace files
