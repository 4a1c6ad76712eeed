// SPDX-License-Identifier: Apache-2.0
// Writes a file that appears complete or not at all.
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

/// The path of an output.
struct Destination {
  std::string path;
  bool force = false;  ///< replace any file; false: replace only files that sixstep has written

  Destination(std::string to, bool over_all = false) : path(std::move(to)), force(over_all) {}
  Destination(const char* to) : path(to) {}
};

/// Writes under a temporary name in the same folder. commit() renames it to its own name, the destructor removes
/// it. Creation already proves that the folder is writable, so create all files before the work begins. A path
/// that is not a regular file (a pipe, /dev/null) is written directly. It refuses files that a ReadLog has
/// noted, because a report must not overwrite its own scenario, and files with is_foreign(). A new file gets
/// the permissions of the one that it replaces. A link stays, and the file that it names is made or replaced;
/// other names of that file (hard links) keep the old content.
class AtomicFile {
 public:
  static base::Result<AtomicFile> create(const Destination& to);

  /// Writes the whole text or nothing. After an error, such as a full disk, later calls write nothing, and
  /// commit() reports the error.
  void write(std::string_view text);

  /// Reserves disk space for this total number of bytes, so that writing them cannot fail for lack of space.
  /// Returns 0, or errno.
  int reserve(std::uint64_t bytes);

  /// A write failed; further writes have no effect.
  bool failed() const { return error_ != 0; }
  /// errno of the failed write; 0: none.
  int error() const { return error_; }
  /// The reader of a pipe has closed it, or an interrupt ended the wait for it: no error of the user.
  bool reader_is_gone() const;
  /// Discards the written text and its error; not for a pipe or a device, which continue.
  void begin_again();

  /// Renames the file to its final name, safely on the disk. Problems: a write failed; the completely written
  /// part is then in NAME.partial.EXT, as the Problem says.
  base::Problems commit() { return commit_as(path_); }

  /// Saves the result of interrupted work as NAME.partial.EXT.
  base::Problems commit_partial();

  const std::string& path() const { return path_; }
  /// The temporary name while writing; empty if there is none.
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
  std::filesystem::path folder_;                    // absolute, if the file has a temporary name
  std::unique_ptr<std::string, Remove> temporary_;  // null if the file is written directly
  std::unique_ptr<int, Close> descriptor_;          // closed before the name is removed
  std::uint64_t size_ = 0;                          // size of the completely written text
  bool waits_ = false;                              // a device or a pipe, whose reader may be slow
  int error_ = 0;
};

/// The Problem that the path cannot be written, with the reason of errno.
base::Problem unwritable(const std::string& path, int reason);

/// The cure if the unfinished file has its partial name.
std::string saved_instead(const std::string& path);

/// "trace.partial.csv" for "trace.csv".
std::string partial_name(const std::string& path);

}  // namespace files
