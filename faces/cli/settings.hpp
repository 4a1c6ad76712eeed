// SPDX-License-Identifier: Apache-2.0
// Reads settings of the command line: key and value.
#pragma once
#include <string>
#include <vector>

#include "faces/cli/rooms.hpp"
#include "files/scenario_on_disk.hpp"

namespace cli {

/// Reads each word as "--set table.key=value"; a word of any other form is a Problem.
files::ReadOptions read_options(const std::string& data_dir, const std::vector<std::string>& sets,
                                base::Problems& problems);

}  // namespace cli
