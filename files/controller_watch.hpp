// SPDX-License-Identifier: Apache-2.0
// Records for each thread which user's controller it executes, with step and run. With this record, the
// report of a crash in foreign code can name the controller. The records are in plain memory, the only memory
// that a signal handler may read.
//
// The controller's code runs in this program, not in a separate process. A controller makes some 30 000 steps
// per simulated second, and a call to another process takes longer than all other work of a control period.
#pragma once
#include <atomic>
#include <cstdint>
#include <string>

namespace files {

enum class ControllerPlace : std::uint8_t { outside, loading, design, start, step, hall };

/// The record of a thread that calls controllers. Its members are atomic, because the watchdog for calls that
/// do not return reads them from another thread.
struct ControllerThread {
  std::atomic<long> thread{0};                   ///< thread number; 0: free
  std::atomic<const char*> controller{nullptr};  ///< path of the controller's file; must stay valid
  std::atomic<ControllerPlace> place{ControllerPlace::outside};
  std::atomic<std::uint64_t> calls{0}, calls_at_stop{0};
  std::atomic<std::uint64_t> steps{0};  ///< steps of the current run
  std::atomic<double> period_s{0.0},
      first_step_s{0.0};  ///< instant of step 1: of its sample, not of a period's end
  std::atomic<std::uint64_t> runs{
      0};  ///< number of the run in a plan, plus 1; 0: no plan. Initialised with zeros, the table takes no
           ///< space in the program file
};

/// A controller's call that lasts longer than `reported_call_s` is reported. A call that lasts longer than
/// `longest_call_s` ends the program. Time in which the program is stopped is not counted.
constexpr int reported_call_s = 2, longest_call_s = 10;

/// The record of the calling thread. The first call in a thread registers the thread, so that its crashes and
/// its end are reported.
ControllerThread& controller_thread();

/// Sets the path of the file that will be loaded; the path must stay valid. The first call installs the
/// handlers of crashes and of the program's end, and starts the watchdog for calls that do not return.
void watch_controllers(const char* path);

/// Sets the number of the plan's run that this thread makes next.
void controllers_make_run(std::uint64_t number);
/// Sets the file that receives a line for each run that ended the program: number, tab, reason. Empty: no
/// file.
void note_stopped_runs_in(const std::string& path);

/// Between these two calls an exit() is attributed to a controller, not to the program's own code.
void controllers_may_run();
void controllers_are_done();

/// Prints a message about this thread's controller, removes temporary files, notes the run, and ends the
/// program with exit code 3, as after a fault.
[[noreturn]] void end_by_controller(const ControllerThread& at, const char* what);

// For the handler of termination signals: notes the present call of each thread.
void mark_controller_calls();
/// Reports the controllers that are still in the call that mark_controller_calls() noted, and notes their
/// runs.
void tell_controllers_that_do_not_come_back();
bool controllers_are_watched();

}  // namespace files
