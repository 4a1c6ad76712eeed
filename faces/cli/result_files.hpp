// SPDX-License-Identifier: Apache-2.0
// The output files of a command that measures something, by the option that names each file.
#pragma once
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "faces/cli/rooms.hpp"
#include "files/atomic_file.hpp"

namespace cli {

class ResultFiles {
 public:
  /// Opens the files before the measurement, so that an unwritable path fails at once. `paths` are pairs of an
  /// option and its path; an empty path is no file. Problems: two options with one path, an unwritable path.
  base::Problems open(const std::vector<std::pair<std::string, std::string>>& paths, bool force);

  bool has(std::string_view option) const;
  /// Writes the whole file and gives it its name. Has no effect if the option has no file. Adds a problem if
  /// the file cannot be written.
  void put(std::string_view option, const std::string& text, base::Problems& problems);

 private:
  std::vector<std::pair<std::string, files::AtomicFile>> files_;
};

}  // namespace cli
