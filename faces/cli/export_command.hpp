// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "faces/cli/verb.hpp"

namespace cli {

/// `sixstep export header SCENARIO`: the scenario's drive as constants for firmware; and `export fmu` (unit_export.hpp).
Verb declare_export(CLI::App& app);

}  // namespace cli
