// SPDX-License-Identifier: Apache-2.0
// Declares sixstep motor fit: constants of a motor from recordings of a bench.
#pragma once
#include "faces/cli/verb.hpp"

namespace cli {

/// Declares a subcommand of the verb `motor`.
Verb declare_fit(CLI::App& motor);

}  // namespace cli
