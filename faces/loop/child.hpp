// SPDX-License-Identifier: Apache-2.0
// Runs a program as a process that ends with this process, in whatever way this process ends.
#pragma once
#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "faces/loop/rooms.hpp"
#include "sixstep/base/result.hpp"

namespace loop {

/// The program's path according to PATH; empty: not found.
std::string on_path(const std::string& program);
/// The Problem of a program that is not on PATH, with the package that contains it.
base::Problem not_here(const std::string& program);

/// A descriptor of this process, and its number in the program.
struct Given {
  int ours, theirs;
};

struct Command {
  std::vector<std::string> words;  ///< the command; its first word is searched on PATH
  std::vector<Given> given;        ///< standard streams that are not listed go to /dev/null
  std::string temporary;           ///< TMPDIR of the program; empty: unchanged
  bool outlives = false;           ///< true: the process is not killed when this process ends
};

class Child {
 public:
  /// Starts the program. Problems: it does not exist, or the system cannot start another process. Ctrl-C at
  /// the terminal does not reach the program.
  static base::Result<Child> start(const Command& command);
  Child(Child&& other) noexcept;
  Child& operator=(Child&& other) noexcept;
  /// Kills the process.
  ~Child();

  /// The exit status of the process; 128 and more: ended by a signal. Empty: the process still runs.
  std::optional<int> ended_within(std::chrono::milliseconds time);
  /// Waits until the process ends by itself.
  void wait();

 private:
  explicit Child(pid_t id) : id_(id) {}
  void end();

  pid_t id_ = -1;
  std::optional<int> status_;
};

}  // namespace loop
