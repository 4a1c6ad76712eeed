// SPDX-License-Identifier: Apache-2.0
#include "faces/cli/settings.hpp"

#include <fmt/format.h>

namespace cli {

files::ReadOptions read_options(const std::string& data_dir, const std::vector<std::string>& sets,
                                base::Problems& problems) {
  files::ReadOptions options{.data_dir = data_dir, .overrides = {}};
  for (const std::string& set : sets) {
    const std::size_t cut = set.find('=');
    if (cut == std::string::npos || cut == 0)
      problems.push_back({.where = fmt::format("--set {}", set),
                          .limit = "does not name a key and a value",
                          .cure = "write --set table.key=value, for example --set supply.voltage_V=12"});
    else
      options.overrides.push_back({set.substr(0, cut), set.substr(cut + 1)});
  }
  return options;
}

}  // namespace cli
