// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "faces/cli/verb.hpp"

namespace cli {

/// `sixstep new [NAME]`: writes a first scenario, which runs and passes without changes.
Verb declare_new(CLI::App& app);

}  // namespace cli
