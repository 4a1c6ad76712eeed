// SPDX-License-Identifier: Apache-2.0
// A zip archive in memory, so that it can be written as one whole file.
#pragma once
#include <string>
#include <vector>

#include "files/rooms.hpp"

namespace files {

struct ZipEntry {
  std::string name;  ///< "sources/a.c"
  std::string content;
  bool packed = true;  ///< false: its bytes stand in the archive as they are
  bool executable = false;
};

/// The archive: the same bytes for the same entries, without dates. Empty if memory ends.
std::string zipped(const std::vector<ZipEntry>& entries);

}  // namespace files
