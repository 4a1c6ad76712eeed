// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "faces/cli/verb.hpp"

namespace cli {

/// `sixstep motor commission MOTOR`: the chip finds out what hangs at it. `failed` where it does not, or a value is out of its bound.
Verb declare_commission(CLI::App& motor);

}  // namespace cli
