// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "faces/cli/verb.hpp"

namespace cli {

/// `sixstep help [KEY]`: all tables, one table, or one key of a scenario or motor file.
Verb declare_help(CLI::App& app);

}  // namespace cli
