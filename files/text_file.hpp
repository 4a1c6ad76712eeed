// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "files/rooms.hpp"
#include "sixstep/base/result.hpp"

namespace files {

/// The whole file, byte for byte.
base::Result<std::string> read_text(const std::string& path);

/// Notes every file that read_text() reads in this thread while the log exists: a scenario's file, its motor
/// file, and all files named in them. If a log ends inside another log, the outer log receives its paths.
class ReadLog {
 public:
  ReadLog();
  ~ReadLog();
  ReadLog(const ReadLog&) = delete;
  ReadLog& operator=(const ReadLog&) = delete;

  /// Paths in the order of reading, including files that could not be read.
  const std::vector<std::string>& paths() const { return paths_; }
  /// Digest of the contents in the order of reading. Paths do not influence it.
  std::uint64_t digest() const { return digest_; }
  /// The text of the first file. It is stored because a pipe can be read only once.
  const std::string& first_text() const { return first_text_; }

  void note(const std::string& path, const std::string& text);

  /// Whether a log of this thread, or a log that ended inside it, has noted the file, by any of its names.
  static bool has(const std::string& path);

 private:
  std::vector<std::string> paths_;
  std::string first_text_;
  std::uint64_t digest_;
  ReadLog* outer_;
};

/// A 64-bit digest of a text; `before` is the digest of the preceding text. It is not cryptographic.
std::uint64_t text_digest(const std::string& text, std::uint64_t before = 0);
/// Like read_text(), for a file that another file names. The file must be regular, because a device or a pipe
/// may never end.
base::Result<std::string> read_regular_text(const std::string& path);

}  // namespace files
