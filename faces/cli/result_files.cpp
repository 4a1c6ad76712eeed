// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/result_files.hpp"

#include <algorithm>

#include "faces/cli/duplicate_outputs.hpp"

namespace cli {

base::Problems ResultFiles::open(const std::vector<std::pair<std::string, std::string>>& paths, bool force) {
  base::Problems problems = duplicate_outputs(paths);
  if (!problems.empty()) return problems;
  for (const auto& [option, path] : paths) {
    if (path.empty()) continue;
    base::Result<files::AtomicFile> file = files::AtomicFile::create({path, force});
    if (file)
      files_.emplace_back(option, std::move(*file));
    else
      append(problems, file.problems());
  }
  return problems;
}

bool ResultFiles::has(std::string_view option) const {
  return std::any_of(files_.begin(), files_.end(), [&](const auto& f) { return f.first == option; });
}

void ResultFiles::put(std::string_view option, const std::string& text, base::Problems& problems) {
  for (auto& [name, file] : files_) {
    if (name != option) continue;
    file.write(text);
    append(problems, file.commit());
  }
}

}  // namespace cli
