// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "faces/cli/verb.hpp"

namespace cli {

/// `sixstep motor commission MOTOR`: the chip measures the connected motor. The exit code is `failed` if the
/// test does not succeed, or if the error of a value exceeds its bound.
Verb declare_commission(CLI::App& motor);

}  // namespace cli
