// SPDX-License-Identifier: Apache-2.0
// The store that the rows of a plan go to.
#pragma once
#include <string>
#include <vector>

#include "faces/cli/plan_reading.hpp"

namespace cli {

/// As --store, --resume and --force say. `identity` is what must not change between two sittings.
base::Result<files::PlanStore> store_of(const RunArguments& arguments, const ReadPlan& plan,
                                        std::string identity);

/// That rows stand in a store, and how to go on with them, for whoever was told to end; empty where none was named or begun.
std::string kept_in(const std::string& store);
/// The same beside the files that lie under partial names; empty where nothing is left.
std::string left_behind(const std::vector<std::string>& partial_files, const std::string& store);

/// The unit of a scenario's key; empty where it has none.
std::string unit_of(const std::string& key);

/// A new one, or one to go on with; what the store says of itself names these options.
base::Result<files::PlanStore> store_at(const std::string& path, bool resume, bool force,
                                        files::StoredPlan plan);

}  // namespace cli
