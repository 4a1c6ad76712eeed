// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "faces/cli/verb.hpp"

namespace cli {

/// `sixstep curve MOTOR`: the torque-speed curve as a table, and as files where asked for.
Verb declare_curve(CLI::App& app);

}  // namespace cli
