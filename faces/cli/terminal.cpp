// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/terminal.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string>

#include "faces/cli/stop_signals.hpp"
#include "text/escape/escape.hpp"

namespace cli {
namespace {

int unprinted = 0;  // errno of the failed write to standard output; 0: none failed

}  // namespace

void print(std::string_view text, std::FILE* to) {
  if (to == stdout && unheard()) return;
  // One call writes all of the text if the kernel allows it. A reader that needs only the first line then
  // does not close the pipe during the writing.
  while (!text.empty()) {
    const ssize_t taken = ::write(::fileno(to), text.data(), text.size());
    if (taken >= 0) {
      text.remove_prefix(static_cast<std::size_t>(taken));
    } else if (errno == EAGAIN) {  // the reader has made the pipe non-blocking: wait until it is writable
      pollfd ready{::fileno(to), POLLOUT, 0};
      ::poll(&ready, 1, -1);
    } else if (errno != EINTR) {
      if (to == stdout) unprinted = errno;
      return;
    }
  }
}

bool unheard() { return unprinted != 0; }

Exit exit_after_printing(Exit exit) {
  if (!unheard()) return exit;
  if (unprinted == EPIPE) return exit == Exit::ok ? Exit::reader_gone : exit;
  complain({{.where = "standard output:",
             .limit = std::string("cannot be written: ") + std::strerror(unprinted),
             .cure = "send the output to a file with free space, or to a program that reads all lines"}});
  return graver(exit, Exit::bad_input);
}

void complain(const base::Problems& problems) {
  std::string text;
  for (const base::Problem& problem : problems) text += text::visible(to_string(problem)) + "\n";
  print(text, stderr);
}

Exit refused(const base::Problems& problems) {
  if (interrupted()) return exit_of_interrupt();
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
  // Opens missing standard streams. open() returns the lowest free number; otherwise an output file would get
  // the number of a stream and contain the printed text. Each stream is opened in the wrong direction, so
  // that reads or writes fail as on a closed stream.
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0) ::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

}  // namespace cli
