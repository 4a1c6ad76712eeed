// SPDX-License-Identifier: Apache-2.0
// Waits until one of the files that sixstep has read is saved again (sixstep run --watch).
#pragma once
#include <string>
#include <vector>

namespace cli {

/// Compares time, size and identity of each file with their values when it was read, ten times a second.
/// Polling works on every disk, on shared folders, and with editors that write another file and rename it.
class FileWatch {
 public:
  explicit FileWatch(std::vector<std::string> paths);

  /// Returns true when a file differs and no file has changed for a moment; false after Ctrl-C.
  bool wait_for_a_change() const;

 private:
  struct Stamp {
    long long when_ns = 0, size = -1;
    unsigned long long identity = 0;
    bool operator==(const Stamp&) const = default;
  };
  std::vector<Stamp> look() const;

  std::vector<std::string> paths_;
  std::vector<Stamp> seen_;
};

}  // namespace cli
