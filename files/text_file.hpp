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

/// Notes every file that read_text() reads in this thread during its life: a scenario's, its motor's, and all
/// files named there. A log inside another passes its paths on to it when it ends.
class ReadLog {
 public:
  ReadLog();
  ~ReadLog();
  ReadLog(const ReadLog&) = delete;
  ReadLog& operator=(const ReadLog&) = delete;

  /// Paths in the order of reading, including files that could not be read.
  const std::vector<std::string>& paths() const { return paths_; }
  /// Digest of the contents in the order of reading. Paths have no influence.
  std::uint64_t digest() const { return digest_; }
  /// The text of the first file, because a pipe can be read only once.
  const std::string& first_text() const { return first_text_; }

  void note(const std::string& path, const std::string& text);

  /// Whether a log of this thread, or one that ended inside it, has noted the file, under any name.
  static bool has(const std::string& path);

 private:
  std::vector<std::string> paths_;
  std::string first_text_;
  std::uint64_t digest_;
  ReadLog* outer_;
};

/// 64 bits of a text; `before` is the digest of the preceding text. Not cryptographic.
std::uint64_t text_digest(const std::string& text, std::uint64_t before = 0);
/// Like read_text(), for a file that another file names. It must be a regular file, because a device or a
/// pipe may never end.
base::Result<std::string> read_regular_text(const std::string& path);

}  // namespace files
