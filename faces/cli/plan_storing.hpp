// SPDX-License-Identifier: Apache-2.0
// The store that the rows of a plan go to.
#pragma once

#include "faces/cli/plan_reading.hpp"

namespace cli {

/// As --store, --resume and --force say. `identity` is what must not change between two sittings.
base::Result<files::PlanStore> store_of(const RunArguments& arguments, const ReadPlan& plan,
                                        std::string identity);

}  // namespace cli
