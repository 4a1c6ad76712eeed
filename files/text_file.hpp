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

/// Notes every file that read_text() reads in this thread while it lives: a scenario's own, its motor's, and
/// whatever they name. One that ends inside another hands on its paths.
class ReadLog {
 public:
  ReadLog();
  ~ReadLog();
  ReadLog(const ReadLog&) = delete;
  ReadLog& operator=(const ReadLog&) = delete;

  /// In the order of reading; those that could not be read too.
  const std::vector<std::string>& paths() const { return paths_; }
  /// Of the contents alone, in the order of reading: where the files lie does not matter.
  std::uint64_t digest() const { return digest_; }
  /// The first file's. A pipe can be read only once.
  const std::string& first_text() const { return first_text_; }

  void note(const std::string& path, const std::string& text);

  /// Whether a log of this thread, or one that ended inside it, has noted that file, under whatever name.
  static bool has(const std::string& path);

 private:
  std::vector<std::string> paths_;
  std::string first_text_;
  std::uint64_t digest_;
  ReadLog* outer_;
};

/// 64 bits of a text, continued from those of what stands before it. No cryptography.
std::uint64_t text_digest(const std::string& text, std::uint64_t before = 0);
/// The same of a file that another file names: it must be one, for a device or a pipe need not end.
base::Result<std::string> read_regular_text(const std::string& path);

}  // namespace files
