// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "faces/cli/exit_code.hpp"
#include "faces/cli/plan_reading.hpp"

namespace cli {

/// Prints estimates for a plan: the number of runs, their time (from a few runs), and the size of the store.
Exit estimate(const RunArguments& arguments, const ReadPlan& plan);

}  // namespace cli
