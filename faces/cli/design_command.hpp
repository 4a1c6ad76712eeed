// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "faces/cli/verb.hpp"

namespace cli {

/// `sixstep design MOTOR`: from the sheet to gains that are known to hold.
Verb declare_design(CLI::App& app);

}  // namespace cli
