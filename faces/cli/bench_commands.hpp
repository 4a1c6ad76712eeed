// SPDX-License-Identifier: Apache-2.0
// Declares sixstep motor identify and sixstep motor emf: measurements of a motor on a bench.
#pragma once
#include "faces/cli/verb.hpp"

namespace cli {

/// Declares subcommands of the verb `motor`.
Verb declare_identify(CLI::App& motor);
Verb declare_emf(CLI::App& motor);

}  // namespace cli
