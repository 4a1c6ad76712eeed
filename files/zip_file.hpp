// SPDX-License-Identifier: Apache-2.0
// A zip archive in memory, to be written as one file.
#pragma once
#include <string>
#include <vector>

#include "files/rooms.hpp"

namespace files {

struct ZipEntry {
  std::string name;  ///< path in the archive, such as "sources/a.c"
  std::string content;
  bool packed = true;  ///< false: the entry's bytes are stored uncompressed
  bool executable = false;
};

/// The archive. The same entries give the same bytes; the archive contains no dates. Empty if memory is
/// short.
std::string zipped(const std::vector<ZipEntry>& entries);

}  // namespace files
