// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/series_command.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <stop_token>
#include <thread>

#include "batch/monte_carlo.hpp"
#include "faces/cli/terminal.hpp"
#include "io/series_table.hpp"

namespace cli {
namespace {

/// Carries Ctrl-C, of which a signal handler may only leave a note, to the runs under way.
class Interrupter {
 public:
  std::stop_token token() const { return stop_.get_token(); }

 private:
  std::stop_source stop_;
  std::jthread watch_{[this](const std::stop_token& done) {
    while (!done.stop_requested()) {
      if (interrupted()) stop_.request_stop();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }};
};

Exit exit_of(const batch::Series& series) {
  Exit exit = series.passed == series.runs ? Exit::ok : Exit::failed;
  if (!series.refused.empty()) exit = graver(exit, Exit::bad_input);
  if (!series.faults.empty()) exit = graver(exit, Exit::fault);
  return exit;
}

}  // namespace

Exit series_command(const RunArguments& arguments, const std::vector<Job>& jobs) {
  catch_interrupts();
  const Interrupter interrupter;
  const bool shows = !arguments.quiet && ::isatty(STDERR_FILENO) != 0;
  const std::size_t step = arguments.runs / 1000 + 1;  // a terminal is slower than a run
  const auto tell = [&](std::size_t done) {
    if (shows && (done % step == 0 || done == arguments.runs))
      print(fmt::format("\r{} of {} done", done, arguments.runs), stderr);
  };
  Exit exit = Exit::ok;
  for (const Job& job : jobs) {
    const batch::Series series = batch::monte_carlo(job.scenario(), {.runs = arguments.runs,
                                                                     .seed = arguments.seed,
                                                                     .jobs = arguments.jobs,
                                                                     .stop = interrupter.token(),
                                                                     .progress = tell});
    if (shows) print("\r\x1b[K", stderr);
    if (!arguments.quiet) print(io::series_table(job.name(), series, arguments.seed));
    exit = graver(exit, interrupted() ? Exit::interrupted : exit_of(series));
    if (interrupted()) break;
  }
  return exit;
}

}  // namespace cli
