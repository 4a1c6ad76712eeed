// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "faces/cli/exit_code.hpp"
#include "faces/cli/plan_reading.hpp"

namespace cli {

/// Estimates a plan without running it: number of runs, time (from a few of them), size of the store.
Exit estimate(const RunArguments& arguments, const ReadPlan& plan);

}  // namespace cli
