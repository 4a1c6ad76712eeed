// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "faces/cli/verb.hpp"

namespace cli {

/// `sixstep compare MOTOR`: compares controllers on one course. Each controller is designed by its own rule.
Verb declare_contest(CLI::App& app);

}  // namespace cli
