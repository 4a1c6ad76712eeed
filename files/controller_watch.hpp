// SPDX-License-Identifier: Apache-2.0
// Records which user controller each thread executes, with step and run, so that the report of a crash in
// foreign code can name the controller. The records are in plain memory, because a signal handler may read
// only that.
//
// The controller's code runs in this program, not in a separate process: a step is called some 30 000 times
// in a simulated second, and a call to another process takes longer than all other work of a control period.
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
  std::atomic<const char*> controller{nullptr};  ///< path of the controller's file, which must stay valid
  std::atomic<ControllerPlace> place{ControllerPlace::outside};
  std::atomic<std::uint64_t> calls{0}, calls_at_stop{0};
  std::atomic<std::uint64_t> steps{0};  ///< steps of the current run
  std::atomic<double> period_s{0.0},
      first_step_s{0.0};  ///< the instant of step 1: a sample's, not a period's end
  std::atomic<std::uint64_t> runs{
      0};  ///< number of the run in a plan, plus 1; 0: no plan. With zeros only, the table takes no room in
           ///< the program's file
};

/// A controller's call that lasts longer than the first time is reported; one that lasts longer than the
/// second time ends the program. Time in which the program is stopped does not count.
constexpr int reported_call_s = 2, longest_call_s = 10;

/// The record of the calling thread. The call also registers the thread, so that its crashes and its end are
/// reported.
ControllerThread& controller_thread();

/// Names the file that will be loaded; the name must stay valid. The first call installs the handlers of
/// crashes and of the program's end, and starts the watchdog for calls that do not return.
void watch_controllers(const char* path);

/// Sets the number of the plan's run that this thread makes next.
void controllers_make_run(std::uint64_t number);
/// Sets the file that gets a line for each run that ended the program: number, tab, reason. Empty: no file.
void note_stopped_runs_in(const std::string& path);

/// Between these two calls an exit() is attributed to a controller, not to the program's own code.
void controllers_may_run();
void controllers_are_done();

/// Prints half a sentence about this thread's controller, removes temporary files, notes the run, and ends
/// the program with exit code 3, as after a fault.
[[noreturn]] void end_by_controller(const ControllerThread& at, const char* what);

// For a handler of termination signals: notes the present call of each thread.
void mark_controller_calls();
/// Reports the controllers that are still in the call that mark_controller_calls() noted, and notes their
/// runs.
void tell_controllers_that_do_not_come_back();
bool controllers_are_watched();

}  // namespace files
