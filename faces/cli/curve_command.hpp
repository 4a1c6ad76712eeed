// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "faces/cli/verb.hpp"

namespace cli {

/// `sixstep curve MOTOR`: the torque-speed curve as a table and, on request, as files.
Verb declare_curve(CLI::App& app);

}  // namespace cli
