// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "faces/cli/verb.hpp"

namespace cli {

/// `sixstep export fmu SCENARIO`: writes the scenario as a functional mock-up unit, for programs that import
/// FMI.
Verb declare_unit_export(CLI::App& exports);

}  // namespace cli
