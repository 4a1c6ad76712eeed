// SPDX-License-Identifier: Apache-2.0
// Runs a program as a process that never outlives this one, however this one ends.
#pragma once
#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "faces/loop/rooms.hpp"
#include "sixstep/base/result.hpp"

namespace loop {

/// The program's path on PATH; empty: not found.
std::string on_path(const std::string& program);
/// The Problem that the program is not on PATH, with the package that has it.
base::Problem not_here(const std::string& program);

/// A descriptor here, and its number in the program.
struct Given {
  int ours, theirs;
};

struct Command {
  std::vector<std::string> words;  ///< the first is searched on PATH
  std::vector<Given> given;        ///< standard streams that are not listed go to /dev/null
  std::string temporary;           ///< its TMPDIR; empty: unchanged
  bool outlives = false;           ///< ends by itself, not with this process
};

class Child {
 public:
  /// Problems: no such program, or no more processes. Ctrl-C at the terminal does not reach it.
  static base::Result<Child> start(const Command& command);
  Child(Child&& other) noexcept;
  Child& operator=(Child&& other) noexcept;
  /// Kills it.
  ~Child();

  /// Its exit status; 128 and more: a signal. Empty: still running.
  std::optional<int> ended_within(std::chrono::milliseconds time);
  /// Waits until it ends by itself.
  void wait();

 private:
  explicit Child(pid_t id) : id_(id) {}
  void end();

  pid_t id_ = -1;
  std::optional<int> status_;
};

}  // namespace loop
