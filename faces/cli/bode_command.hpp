// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "faces/cli/exit_code.hpp"
#include "faces/cli/run_command.hpp"

namespace cli {

/// `sixstep run --bode SCENARIO`: the frequency response of the drive's outermost loop, measured at the
/// operating point where the scenario ends.
Exit bode_command(const RunArguments& arguments);

}  // namespace cli
