// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "faces/cli/exit_code.hpp"

namespace cli {

/// `sixstep help [KEY]`: all tables, one table, or one key of a scenario or motor file.
Exit help_command(const std::string& key);

}  // namespace cli
