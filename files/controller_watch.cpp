// SPDX-License-Identifier: Apache-2.0
#include "files/controller_watch.hpp"

#include <fcntl.h>
#include <pthread.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <mutex>
#include <string_view>
#include <thread>

#include "files/signal_line.hpp"
#include "files/temporary_names.hpp"

namespace files {
namespace {

constexpr int exit_of_a_fault = 3;
constexpr std::size_t most_threads = 1024;
ControllerThread threads[most_threads];
std::atomic<bool> watched = false, ours_at_work = false;
std::atomic<const char*> last_loaded = nullptr;
char noted_in[4096];  // a path that a signal handler opens

long this_thread() { return ::syscall(SYS_gettid); }

/// Finds the record by the thread's number, because the controller may have overwritten thread-local memory.
ControllerThread* found_thread() {
  const long me = this_thread();
  for (ControllerThread& t : threads)
    if (t.thread.load() == me) return &t;
  return nullptr;
}

/// Writes "in step 20, at t = 0.000570 s", as in the message of a run's fault. The instant is the step's
/// sample.
void tell_place(SignalLine& to, const ControllerThread& at) {
  const ControllerPlace place = at.place;
  if (place == ControllerPlace::loading) to << " while it was loaded";
  if (place == ControllerPlace::design) to << " in its design";
  if (place == ControllerPlace::start) to << " in its start";
  if (place != ControllerPlace::step && place != ControllerPlace::hall) return;
  const std::uint64_t steps = at.steps;
  const double periods = steps > 0 ? static_cast<double>(steps - 1) : 0.0;
  const auto us = static_cast<std::uint64_t>(std::llround((at.first_step_s + periods * at.period_s) * 1e6));
  to << (place == ControllerPlace::hall ? " in its hall() after step " : " in step ") << steps
     << (place == ControllerPlace::hall ? ", after t = " : ", at t = ") << us / 1000000 << ".";
  for (std::uint64_t weight = 100000; weight > 0; weight /= 10) to << us / weight % 10;
  to << " s";
}

void tell(const ControllerThread& at, const char* what, std::string_view more) {
  SignalLine words;
  const char* const controller = at.controller;
  words << (controller ? controller : "a controller") << ": the controller " << what;
  tell_place(words, at);
  if (at.runs > 0) words << ", of run " << at.runs - 1;
  write_out(STDERR_FILENO, (words << more).line());
}

void note_run(const ControllerThread& at, const char* what) {
  if (at.runs == 0 || noted_in[0] == '\0') return;
  const int descriptor = ::open(noted_in, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor < 0) return;
  SignalLine words;
  words << at.runs - 1 << "\t" << at.controller.load() << ": the controller " << what;
  tell_place(words, at);
  write_out(descriptor, words.line());
  ::close(descriptor);
}

const char* crash_of(int signal) {
  switch (signal) {
    case SIGSEGV:
      return "crashed (SIGSEGV: access to memory that does not belong to the program)";
    case SIGBUS:
      return "crashed (SIGBUS: access to memory that does not exist)";
    case SIGFPE:
      return "crashed (SIGFPE: a division by zero, or an enabled floating-point exception)";
    case SIGILL:
      return "crashed (SIGILL: an instruction that this processor lacks)";
    case SIGTRAP:
      return "crashed (SIGTRAP)";
    default:
      return "ended itself by abort() (SIGABRT)";
  }
}

constexpr int crashes[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP};
struct sigaction before_us[64];

extern "C" void on_crash(int signal, siginfo_t*, void*) {
  const ControllerThread* const at = found_thread();
  if (at && at->place != ControllerPlace::outside) end_by_controller(*at, crash_of(signal));
  // The crash is not in a controller's code, but a controller may have overwritten memory. After this
  // message, the previous handler is called.
  SignalLine words;
  words << "sixstep crashed; " << (last_loaded.load() ? last_loaded.load() : "a controller")
        << " runs in this program and may have overwritten its memory";
  write_out(STDERR_FILENO, words.line());
  remove_temporary_files();
  ::sigaction(signal, &before_us[signal], nullptr);
  ::raise(signal);
}

extern "C" void on_exit_of_the_program() {
  if (const ControllerThread* at = found_thread(); at && at->place != ControllerPlace::outside)
    end_by_controller(*at, "ended the program by exit()");
  if (!ours_at_work) return;
  ControllerThread somewhere;
  somewhere.controller = last_loaded.load();
  end_by_controller(somewhere, "ended the program by exit() in a thread that it had started");
}

/// A thread's call as last seen by the watchdog, and the number of checks that found the same call.
struct SeenCall {
  std::uint64_t calls = 0;
  int looks = 0;
};

/// Checks ten times a second. It counts checks instead of reading a clock: while a debugger or Ctrl-Z stops
/// the program, neither calls nor checks proceed.
void* watch_calls(void*) {
  constexpr int looks_a_second = 10;
  static SeenCall seen[most_threads];
  while (true) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1000 / looks_a_second));
    for (std::size_t n = 0; n < most_threads; ++n) {
      const ControllerThread& t = threads[n];
      const std::uint64_t calls = t.calls;
      const bool same = t.thread != 0 && t.place != ControllerPlace::outside && calls == seen[n].calls;
      seen[n] = {calls, same ? seen[n].looks + 1 : 0};
      if (seen[n].looks == reported_call_s * looks_a_second)
        tell(t, "has not answered for 2 s", "; after 10 s the program ends");
      if (seen[n].looks == longest_call_s * looks_a_second) end_by_controller(t, "has not answered for 10 s");
    }
  }
}

/// Blocks all signals in the watchdog's thread: a signal must interrupt the thread that waits for it.
void start_watch_of_calls() {
  sigset_t all, before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);
  pthread_t watch{};  // not std::thread, which throws if the system cannot start another thread
  if (::pthread_create(&watch, nullptr, watch_calls, nullptr) == 0) ::pthread_detach(watch);
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
}
static_assert(reported_call_s == 2 && longest_call_s == 10, "their messages have these numbers");

void watch_the_end() {
  struct sigaction act {};
  act.sa_sigaction = on_crash;
  act.sa_flags = SA_SIGINFO | SA_ONSTACK | SA_NODEFER;
  for (const int signal : crashes) ::sigaction(signal, &act, &before_us[signal]);
  std::atexit(on_exit_of_the_program);
  std::at_quick_exit(on_exit_of_the_program);
  start_watch_of_calls();
}

/// A separate stack for the signal handler, because an overflowed stack has no space for it.
struct HandlerStack {
  static constexpr std::size_t bytes = 65536;
  std::unique_ptr<char[]> room = std::make_unique<char[]>(bytes);
  HandlerStack() { set(0); }
  ~HandlerStack() { set(SS_DISABLE); }
  HandlerStack(const HandlerStack&) = delete;
  HandlerStack& operator=(const HandlerStack&) = delete;
  void set(int flags) {
    stack_t stack{};
    stack.ss_sp = room.get();
    stack.ss_size = bytes;
    stack.ss_flags = flags;
    ::sigaltstack(&stack, nullptr);
  }
};

/// Called at the end of a thread, in whatever way the thread ends.
extern "C" void on_end_of_thread(void* thread) {
  const auto* const at = static_cast<const ControllerThread*>(thread);
  if (at->place != ControllerPlace::outside)
    end_by_controller(*at, "ended its thread, for example by pthread_exit()");
}
pthread_key_t end_of_thread() {
  static const pthread_key_t key = [] {
    pthread_key_t made{};
    ::pthread_key_create(&made, on_end_of_thread);
    return made;
  }();
  return key;
}

/// Registers the thread with the watchdog while the thread exists.
struct Membership {
  HandlerStack stack;
  ControllerThread* at = nullptr;
  ControllerThread beyond_the_last;

  Membership() {
    const long me = this_thread();
    at = &beyond_the_last;
    for (ControllerThread& t : threads) {
      long nobody = 0;
      if (!t.thread.compare_exchange_strong(nobody, me)) continue;
      at = &t;
      break;
    }
    ::pthread_setspecific(end_of_thread(), at);
  }
  ~Membership() {
    // This destructor also runs if a controller calls exit(); the handler of exit() then reports the call.
    if (at->place != ControllerPlace::outside) return;
    at->runs = 0;
    at->thread = 0;
  }
  Membership(const Membership&) = delete;
  Membership& operator=(const Membership&) = delete;
};

}  // namespace

ControllerThread& controller_thread() {
  thread_local Membership membership;
  return *membership.at;
}

void watch_controllers(const char* path) {
  static std::once_flag once;
  std::call_once(once, watch_the_end);
  last_loaded = path;
  watched = true;
}

bool controllers_are_watched() { return watched; }

void controllers_make_run(std::uint64_t number) {
  if (watched) controller_thread().runs = number + 1;
}

void note_stopped_runs_in(const std::string& path) {
  noted_in[0] = '\0';
  if (path.size() < sizeof noted_in) std::memcpy(noted_in, path.c_str(), path.size() + 1);
}

void controllers_may_run() { ours_at_work = true; }
void controllers_are_done() { ours_at_work = false; }

void end_by_controller(const ControllerThread& at, const char* what) {
  note_run(at, what);
  tell(at, what, "; the program ends here, and unfinished results are lost");
  remove_temporary_files();
  ::syscall(SYS_exit_group, exit_of_a_fault);
  std::abort();
}

void mark_controller_calls() {
  for (ControllerThread& t : threads) t.calls_at_stop = t.calls.load();
}

void tell_controllers_that_do_not_come_back() {
  constexpr char what[] = "does not return";
  for (const ControllerThread& t : threads) {
    if (t.thread == 0 || t.place == ControllerPlace::outside || t.calls != t.calls_at_stop) continue;
    note_run(t, what);  // noted before the message, because the user may interrupt again after the message
    tell(t, what, "; press Ctrl-C again to end the program (or send a second SIGTERM)");
  }
}

}  // namespace files

// Replaces functions of the C library that would end the program without a message. A shared object that
// calls a function of this name calls the program's version.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
extern "C" {
__attribute__((noreturn, visibility("default"))) void _exit(int code) {
  if (const files::ControllerThread* at = files::found_thread();
      at && at->place != files::ControllerPlace::outside)
    files::end_by_controller(*at, "ended the program by _exit()");
  ::syscall(SYS_exit_group, code);
  __builtin_trap();
}
__attribute__((noreturn, visibility("default"))) void _Exit(int code) noexcept { _exit(code); }
}
#endif
