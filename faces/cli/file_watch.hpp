// SPDX-License-Identifier: Apache-2.0
// sixstep run --watch: waits until one of the files that were read is saved.
#pragma once
#include <string>
#include <vector>

namespace cli {

/// How the files looked when they were read. A file's time, size and identity are asked for ten times a
/// second: that works on every disk, on shared folders, and with editors that write another file and rename
/// it.
class FileWatch {
 public:
  explicit FileWatch(std::vector<std::string> paths);

  /// Returns once a file differs and all have stayed as they are for a moment; false where Ctrl-C came first.
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
