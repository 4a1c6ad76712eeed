// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <string>

namespace cli {
namespace {

volatile std::sig_atomic_t asked_to_end = 0;

extern "C" void on_interrupt(int signal) {
  asked_to_end = signal;
  std::signal(signal, SIG_DFL);  // a second time ends at once
}

}  // namespace

void print(std::string_view text, std::FILE* to) {
  std::fwrite(text.data(), 1, text.size(), to);
  std::fflush(to);
}

void complain(const base::Problems& problems) {
  std::string text;
  for (const base::Problem& problem : problems) text += to_string(problem) + "\n";
  print(text, stderr);
}

Exit refused(const base::Problems& problems) {
  complain(problems);
  return Exit::bad_input;
}

bool may_colour(std::FILE* stream) {
  const char* forbidden = std::getenv("NO_COLOR");
  return ::isatty(::fileno(stream)) != 0 && (forbidden == nullptr || *forbidden == '\0');
}

std::size_t terminal_width(std::FILE* stream) {
  const char* kind = std::getenv("TERM");
  if (::isatty(::fileno(stream)) == 0 || (kind && std::string_view(kind) == "dumb")) return 0;
  constexpr std::size_t usual = 80;
  winsize size{};
  return ::ioctl(::fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : usual;
}

void take_write_errors() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void catch_interrupts() {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
}
bool interrupted() { return asked_to_end != 0; }
Exit exit_of_interrupt() { return asked_to_end == SIGTERM ? Exit::terminated : Exit::interrupted; }

}  // namespace cli
