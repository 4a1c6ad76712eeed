// SPDX-License-Identifier: Apache-2.0
// A program that is run as a process of its own and never outlives whoever started it, however that ends.
#pragma once
#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "faces/loop/rooms.hpp"
#include "sixstep/base/result.hpp"

namespace loop {

/// Where PATH finds a program; empty: nowhere.
std::string on_path(const std::string& program);
/// That it does so nowhere, and what brings it.
base::Problem not_here(const std::string& program);

/// A descriptor of ours and the number under which the program finds it.
struct Given {
  int ours, theirs;
};

struct Command {
  std::vector<std::string> words;  ///< the first is looked for on PATH
  std::vector<Given> given;        ///< standard streams that are not among them lead nowhere
  std::string temporary;           ///< its TMPDIR, where it says one
  bool outlives = false;           ///< ends by itself instead of with us
};

class Child {
 public:
  /// Problems: no such program, or no more processes. Ctrl-C at the terminal does not reach it.
  static base::Result<Child> start(const Command& command);
  Child(Child&& other) noexcept;
  Child& operator=(Child&& other) noexcept;
  /// Ends it at once.
  ~Child();

  /// Its exit status, 128 and more: a signal's. Empty: it still runs.
  std::optional<int> ended_within(std::chrono::milliseconds time);
  /// Waits for one that ends by itself.
  void wait();

 private:
  explicit Child(pid_t id) : id_(id) {}
  void end();

  pid_t id_ = -1;
  std::optional<int> status_;
};

}  // namespace loop
