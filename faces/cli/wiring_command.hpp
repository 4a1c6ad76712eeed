// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "faces/cli/verb.hpp"

namespace cli {

/// `sixstep motor wiring MOTOR`: what the motor does plugged in in each of the 36 ways. `failed` where simulation and theory differ.
Verb declare_wiring(CLI::App& motor);

}  // namespace cli
