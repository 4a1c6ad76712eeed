// SPDX-License-Identifier: Apache-2.0
// A file that appears whole or not at all.
#pragma once
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include "io/rooms.hpp"
#include "sixstep/base/result.hpp"

namespace io {

/// Writes to a temporary name in the same folder; commit() puts it in place, going out of scope removes it.
/// Creating it already proves that the folder can be written, so create all of them before the work begins.
/// What is no regular file (a pipe, /dev/null) is written as it is.
class AtomicFile {
 public:
  static base::Result<AtomicFile> create(const std::string& path);

  /// A failed write is remembered and told by commit().
  void write(std::string_view text);

  /// Empty when the file stands under its name, safely on the disk.
  base::Problems commit() { return commit_as(path_); }

  /// What an interrupted work leaves: NAME.partial.EXT.
  base::Problems commit_partial();

  const std::string& path() const { return path_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  struct Remove {
    void operator()(std::string* name) const;
  };
  AtomicFile() = default;
  base::Problems commit_as(const std::string& path);

  std::string path_;
  std::unique_ptr<std::string, Remove> temporary_;  // null where the file is written as it is
  std::unique_ptr<std::FILE, Close> file_;          // closed before the name goes
  int error_ = 0;
};

/// "trace.partial.csv" of "trace.csv".
std::string partial_name(const std::string& path);

}  // namespace io
