// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "faces/cli/rooms.hpp"
#include "sixstep/base/problem.hpp"

namespace cli {

/// Problems of options that name the same file, in any spelling. `outputs`: options with their files; "" and "-"
/// are ignored.
base::Problems duplicate_outputs(const std::vector<std::pair<std::string, std::string>>& outputs);

}  // namespace cli
