// SPDX-License-Identifier: Apache-2.0
#include "faces/loop/child.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <thread>

#include "faces/loop/installed.hpp"

namespace loop {

namespace {

/// All arguments of exec, prepared before the fork. After the fork, memory must not be allocated: another
/// thread may have held the allocator's lock, which then stays locked.
struct Prepared {
  std::string program;
  std::vector<std::string> environment;
  std::vector<char*> words, variables;

  explicit Prepared(const Command& command) : program(on_path(command.words.front())) {
    for (const std::string& word : command.words) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    for (char** variable = environ; *variable != nullptr; ++variable)
      if (command.temporary.empty() || std::strncmp(*variable, "TMPDIR=", 7) != 0)
        environment.emplace_back(*variable);
    if (!command.temporary.empty()) environment.push_back("TMPDIR=" + command.temporary);
    for (std::string& variable : environment) variables.push_back(variable.data());
    variables.push_back(nullptr);
  }
};

/// Replaces the child process by the program. Between fork and exec only system calls are allowed.
[[noreturn]] void become(const Prepared& prepared, const Command& command,
                         const std::vector<Given>& out_of_the_way, pid_t parent) {
  ::setpgid(0, 0);
  if (!command.outlives) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(127);
  }
  const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  for (int stream = 0; stream < 3; ++stream) ::dup2(nowhere, stream);
  for (const Given& given : out_of_the_way) ::dup2(given.ours, given.theirs);
  ::execve(prepared.program.c_str(), prepared.words.data(), prepared.variables.data());
  ::_exit(127);
}

}  // namespace

std::string on_path(const std::string& program) {
  if (program.find('/') != std::string::npos) return ::access(program.c_str(), X_OK) == 0 ? program : "";
  const char* const path = std::getenv("PATH");
  std::string folders = path != nullptr ? path : "/usr/bin:/bin";
  folders += ':';
  for (std::size_t from = 0, to; (to = folders.find(':', from)) != std::string::npos; from = to + 1) {
    std::string file = folders.substr(from, to - from);
    file += (file.empty() ? "./" : "/") + program;
    if (::access(file.c_str(), X_OK) == 0) return file;
  }
  return "";
}

base::Problem not_here(const std::string& program) {
  const bool is_ours = program.starts_with("sixstep-");
  return {
      program, "", "is not installed on this machine",
      is_ours
          ? "install the package sixstep-avr-board, or in a checkout run tools/install.sh target and build sixstep again"
          : "install its package: " + (sources_folder() / "tools/packages.txt").string() +
                " lists the packages for cores under [target]"};
}

base::Result<Child> Child::start(const Command& command) {
  const Prepared prepared(command);
  if (prepared.program.empty()) return not_here(command.words.front());
  // Descriptors are first copied to temporary numbers above all requested numbers, so that no descriptor is
  // overwritten before it is copied.
  std::vector<Given> out_of_the_way;
  for (const Given& given : command.given)
    out_of_the_way.push_back({::fcntl(given.ours, F_DUPFD_CLOEXEC, 64), given.theirs});
  const pid_t parent = ::getpid();
  const pid_t id = ::fork();
  if (id == 0) become(prepared, command, out_of_the_way, parent);
  const int failed = errno;
  for (const Given& given : out_of_the_way) ::close(given.ours);
  if (id < 0)
    return base::Problem{command.words.front(), "",
                         std::string("cannot be started: ") + std::strerror(failed),
                         "end other programs, and run the command again"};
  return Child(id);
}

Child::Child(Child&& other) noexcept : id_(std::exchange(other.id_, -1)), status_(other.status_) {}
Child& Child::operator=(Child&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(status_, other.status_);
  return *this;
}
Child::~Child() { end(); }

void Child::end() {
  if (id_ < 0 || status_) return;
  ::kill(id_, SIGKILL);
  wait();
}

void Child::wait() {
  if (id_ < 0 || status_) return;
  int status = 0;
  while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) {
  }
  status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::optional<int> Child::ended_within(std::chrono::milliseconds time) {
  const auto until = std::chrono::steady_clock::now() + time;
  while (id_ >= 0 && !status_) {
    int status = 0;
    if (::waitpid(id_, &status, WNOHANG) == id_)
      status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    else if (std::chrono::steady_clock::now() >= until)
      break;
    else
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return status_;
}

}  // namespace loop
