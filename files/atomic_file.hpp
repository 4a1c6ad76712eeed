// SPDX-License-Identifier: Apache-2.0
// A file that appears whole or not at all.
#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "files/rooms.hpp"
#include "sixstep/base/result.hpp"

struct stat;

namespace files {

/// Where an output goes.
struct Destination {
  std::string path;
  bool force = false;  ///< over whatever is there; else only over what sixstep has written

  Destination(std::string to, bool over_all = false) : path(std::move(to)), force(over_all) {}
  Destination(const char* to) : path(to) {}
};

/// Writes to a temporary name in the same folder; commit() puts it in place, going out of scope removes it.
/// Creating it already proves that the folder can be written, so create all of them before the work begins.
/// What is not a regular file (a pipe, /dev/null) is written as it is. A file that a ReadLog has noted is
/// refused: nobody means to lose a scenario to its own report; and so is a file that is_foreign().
/// What takes another file's place has its permissions. A link keeps its place, and what it names is made or
/// replaced; other names of the file itself (hard links) keep the old one.
class AtomicFile {
 public:
  static base::Result<AtomicFile> create(const Destination& to);

  /// All of the text or nothing of it. Where the disk is full or the like, nothing more is written from there
  /// on, and commit() tells.
  void write(std::string_view text);

  /// Room on the disk for that many bytes in all, so that writing them cannot fail for want of it; 0, or what
  /// errno says.
  int reserve(std::uint64_t bytes);

  /// A write failed: there is no sense in going on.
  bool failed() const { return error_ != 0; }
  /// What errno said of it; 0 where all went well.
  int error() const { return error_; }
  /// The reader of a pipe has seen enough, or who waits for it has: nobody is to blame.
  bool reader_is_gone() const;
  /// Forgets what was written, and that it failed; a pipe or a device goes on.
  void begin_again();

  /// Empty when the file stands under its name, safely on the disk. Where a write failed, what was whole
  /// before stands under NAME.partial.EXT, and the Problem says so.
  base::Problems commit() { return commit_as(path_); }

  /// What an interrupted work leaves: NAME.partial.EXT.
  base::Problems commit_partial();

  const std::string& path() const { return path_; }
  /// Where it is written to. Empty where there is no such name.
  std::string temporary() const { return temporary_ ? *temporary_ : std::string(); }

 private:
  struct Close {
    void operator()(int* descriptor) const;
  };
  struct Remove {
    void operator()(std::string* name) const;
  };
  AtomicFile() = default;
  int open_device();
  int open_beside(const struct stat* old);
  base::Problems commit_as(const std::string& path);
  base::Problems save_what_is_whole();
  int put_in_place(const std::string& path);

  std::string path_;
  std::filesystem::path folder_;                    // whole, of a file that has a temporary name
  std::unique_ptr<std::string, Remove> temporary_;  // null where the file is written as it is
  std::unique_ptr<int, Close> descriptor_;          // closed before the name goes
  std::uint64_t size_ = 0;                          // of what was written whole
  bool waits_ = false;                              // a device or a pipe, whose reader may be slow
  int error_ = 0;
};

/// That the path cannot be written, for what errno says.
base::Problem unwritable(const std::string& path, int reason);

/// The cure where an unfinished file stands under its partial name.
std::string saved_instead(const std::string& path);

/// "trace.partial.csv" of "trace.csv".
std::string partial_name(const std::string& path);

}  // namespace files
