// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "faces/cli/exit_code.hpp"
#include "faces/cli/plan_reading.hpp"

namespace cli {

/// What a plan would take, without making it: its runs, the time of a few of them, and the store's size.
Exit estimate(const RunArguments& arguments, const ReadPlan& plan);

}  // namespace cli
