// SPDX-License-Identifier: Apache-2.0
// sixstep motor identify and sixstep motor emf: a motor on a bench.
#pragma once
#include "faces/cli/verb.hpp"

namespace cli {

/// Declared below the verb `motor`.
Verb declare_identify(CLI::App& motor);
Verb declare_emf(CLI::App& motor);

}  // namespace cli
