// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/stop_signals.hpp"

#include <unistd.h>

#include <atomic>
#include <csignal>

#include "faces/cli/terminal.hpp"
#include "files/controller_watch.hpp"
#include "files/temporary_names.hpp"

namespace cli {
namespace {

struct StopSignal {
  int number;
  /// true: a second signal of this kind ends the program at once. This applies only to signals that the user
  /// alone can send twice: SIGHUP arrives twice when a terminal closes, from the kernel and from the shell,
  /// and SIGXCPU arrives once a second.
  bool again_ends_at_once;
};
constexpr StopSignal stop_signals[] = {
    {SIGINT, true}, {SIGTERM, true}, {SIGQUIT, true}, {SIGHUP, false}, {SIGXCPU, false}};

volatile std::sig_atomic_t asked_to_end = 0, puts_in_order = 0;
std::atomic<bool> stop_told = false, as_asked = false;

void end_at_once(int signal) {
  files::remove_temporary_files();
  std::signal(signal, SIG_DFL);
  std::raise(signal);  // delivered when the handler returns
}

extern "C" void on_stop_signal(int signal) {
  if (puts_in_order == 0) return end_at_once(signal);
  bool again = false;
  for (const StopSignal& stop : stop_signals)
    again = again || (stop.number == signal && stop.again_ends_at_once && asked_to_end == signal);
  if (again) return end_at_once(signal);
  asked_to_end = signal;
  if (!files::controllers_are_watched()) return;
  // Marks the calls of users' controllers that are in progress. All code outside such a call ends within a
  // second.
  files::mark_controller_calls();
  ::alarm(1);
}

extern "C" void on_alarm(int) { files::tell_controllers_that_do_not_come_back(); }

}  // namespace

void take_stop_signals() {
  struct sigaction ask {
  }, before{};
  ask.sa_handler = on_stop_signal;
  // SA_RESTART is not set, so that a signal ends a wait for a pipe's other end.
  for (const StopSignal& stop : stop_signals) {
    // SIGHUP and SIGQUIT may already be ignored: nohup ignores SIGHUP, and a shell ignores the keyboard's
    // SIGQUIT for a background job.
    const bool may_be_ignored = stop.number == SIGHUP || stop.number == SIGQUIT;
    if (may_be_ignored && ::sigaction(stop.number, nullptr, &before) == 0 && before.sa_handler == SIG_IGN)
      continue;
    ::sigaction(stop.number, &ask, nullptr);
  }
  ask.sa_handler = on_alarm;
  ask.sa_flags = SA_RESTART;
  ::sigaction(SIGALRM, &ask, nullptr);
}

void catch_interrupts() { puts_in_order = 1; }
bool interrupted() { return asked_to_end != 0; }
Exit exit_of_interrupt() { return static_cast<Exit>(128 + asked_to_end); }

void stop_is_told() { stop_told = true; }

void tell_stop(const std::string& line) {
  print(line + "\n", stderr);
  stop_is_told();
}

Exit told_interrupted(const std::string& what, const std::string& kept) {
  tell_stop(what + ": interrupted; " + (kept.empty() ? "nothing was written" : kept));
  return exit_of_interrupt();
}

Exit ended_as_asked(Exit exit) {
  as_asked = true;
  return exit;
}

Exit exit_after_stop(Exit exit) {
  if (!interrupted() || as_asked) return exit;
  if (!stop_told)
    for (const ExitMeaning& meaning : exit_meanings)
      if (meaning.code == exit_of_interrupt()) tell_stop(std::string(meaning.meaning));
  return exit_of_interrupt();
}

}  // namespace cli
