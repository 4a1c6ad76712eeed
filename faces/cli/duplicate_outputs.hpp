// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "faces/cli/rooms.hpp"
#include "sixstep/base/problem.hpp"

namespace cli {

/// Options with the files they name, "" and "-" left out: the same file twice, in whatever spelling.
base::Problems duplicate_outputs(const std::vector<std::pair<std::string, std::string>>& outputs);

}  // namespace cli
