// SPDX-License-Identifier: Apache-2.0
// Writes a file that appears either complete or not at all.
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
  bool force = false;  ///< true: replace any file; false: replace only files that sixstep has written

  Destination(std::string to, bool over_all = false) : path(std::move(to)), force(over_all) {}
  Destination(const char* to) : path(to) {}
};

/// Writes a file under a temporary name in the same folder. commit() renames the file to its own name; the
/// destructor removes it if commit() was not called.
/// - Creation already proves that the folder is writable. So create all files before the work begins.
/// - A path that is not a regular file (a pipe, /dev/null) is written directly.
/// - Files that a ReadLog has noted are refused, because a report must not overwrite its own scenario. Files
///   with is_foreign() are refused too.
/// - A new file has the permissions of the file that it replaces.
/// - A symbolic link is kept, and its target is created or replaced. Other names of the target (hard links)
/// keep
/// the old content.
class AtomicFile {
 public:
  static base::Result<AtomicFile> create(const Destination& to);

  /// Writes the whole text or nothing. After an error, such as a full disk, later calls write nothing, and
  /// commit() reports the error.
  void write(std::string_view text);

  /// Reserves disk space for this total number of bytes, so that writing them cannot fail for lack of space.
  /// Returns 0 or errno.
  int reserve(std::uint64_t bytes);

  /// Whether a write failed; further writes then have no effect.
  bool failed() const { return error_ != 0; }
  /// errno of the failed write; 0: no write failed.
  int error() const { return error_; }
  /// Whether the reader of a pipe has closed it, or an interrupt ended the wait for the reader. Neither is
  /// the user's error.
  bool reader_is_gone() const;
  /// Discards the written text and its error. Has no effect on a pipe or a device, where written text cannot
  /// be discarded.
  void begin_again();

  /// Renames the file to its final name and synchronises the disk. Problems: a write failed. The completely
  /// written part is then in NAME.partial.EXT, as the Problem says.
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
  std::filesystem::path folder_;                    // absolute path, if the file has a temporary name
  std::unique_ptr<std::string, Remove> temporary_;  // null if the file is written directly
  std::unique_ptr<int, Close> descriptor_;  // declared last, so that it is closed before the name is removed
  std::uint64_t size_ = 0;                  // size of the completely written text
  bool waits_ = false;                      // true for a device or a pipe, whose reader may be slow
  int error_ = 0;
};

/// The Problem of a path that cannot be written, with the reason of errno.
base::Problem unwritable(const std::string& path, int reason);

/// The cure if the unfinished file was saved under its partial name.
std::string saved_instead(const std::string& path);

/// The name of an unfinished file: "trace.partial.csv" for "trace.csv".
std::string partial_name(const std::string& path);

}  // namespace files
