// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/duplicate_outputs.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <map>

namespace cli {

base::Problems duplicate_outputs(const std::vector<std::pair<std::string, std::string>>& outputs) {
  namespace fs = std::filesystem;
  base::Problems problems;
  std::map<std::string, std::string> seen;
  for (const auto& [option, path] : outputs) {
    std::error_code none;
    if (path.empty() || path == "-" || fs::is_other(path, none) || fs::is_character_file(path, none))
      continue;  // several outputs may be written to /dev/null
    const fs::path whole = fs::weakly_canonical(fs::absolute(path, none), none);
    const auto [other, is_new] = seen.emplace(none ? path : whole.string(), option);
    if (!is_new)
      problems.push_back({.where = option,
                          .value = path,
                          .limit = fmt::format("is also the file of {}", other->second),
                          .cure = "give each output its own file"});
  }
  return problems;
}

}  // namespace cli
