// SPDX-License-Identifier: Apache-2.0
// Opens the store for the rows of a plan.
#pragma once
#include <string>
#include <vector>

#include "faces/cli/plan_reading.hpp"

namespace cli {

/// Opens the store according to --store, --resume and --force. To continue a store, `identity` must be equal
/// to its identity.
base::Result<files::PlanStore> store_of(const RunArguments& arguments, const ReadPlan& plan,
                                        std::string identity);

/// The message after an interrupt. It says that the store contains the finished rows, and how to continue.
/// Empty without a store.
std::string kept_in(const std::string& store);
/// The text of kept_in(), followed by the files with partial names. Empty if no file remains.
std::string left_behind(const std::vector<std::string>& partial_files, const std::string& store);

/// The unit of a scenario's key; empty if it has none.
std::string unit_of(const std::string& key);

/// Opens a new store, or an existing one to continue it. Its Problems name the options --resume and --force.
base::Result<files::PlanStore> store_at(const std::string& path, bool resume, bool force,
                                        files::StoredPlan plan);

}  // namespace cli
