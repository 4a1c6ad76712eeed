// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/series_command.hpp"

#include <chrono>
#include <optional>
#include <stop_token>
#include <thread>

#include "batch/monte_carlo.hpp"
#include "faces/cli/progress.hpp"
#include "faces/cli/terminal.hpp"
#include "text/results/series_table.hpp"

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

Exit exit_of(const analysis::Series& series) {
  Exit exit = series.passed == series.runs ? Exit::ok : Exit::failed;
  if (!series.refused.empty()) exit = graver(exit, Exit::bad_input);
  if (!series.faults.empty()) exit = graver(exit, Exit::fault);
  return exit;
}

}  // namespace

Exit series_command(const RunArguments& arguments, const std::vector<Job>& jobs) {
  catch_interrupts();
  const Interrupter interrupter;
  Exit exit = Exit::ok;
  for (const Job& job : jobs) {
    std::optional<Progress> progress;
    progress.emplace(Work{.seconds = {}, .pieces = arguments.runs}, arguments.quiet);
    const analysis::Series series = batch::monte_carlo(
        job.scenario(), {.runs = arguments.runs,
                         .seed = arguments.seed,
                         .jobs = arguments.jobs,
                         .stop = interrupter.token(),
                         .progress = [&](std::size_t done) { progress->pieces_done(done); }});
    progress.reset();
    if (!arguments.quiet) print(text::series_table(job.name(), series, arguments.seed, arguments.runs));
    exit = graver(exit, interrupted() ? exit_of_interrupt() : exit_of(series));
    if (interrupted()) break;
  }
  return exit;
}

}  // namespace cli
