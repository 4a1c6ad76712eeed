// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "faces/cli/verb.hpp"

namespace cli {

/// `sixstep motor wiring MOTOR`: simulates the motor for each of the 36 ways to connect it. The exit code is
/// `failed` if simulation and theory differ.
Verb declare_wiring(CLI::App& motor);

}  // namespace cli
