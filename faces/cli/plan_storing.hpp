// SPDX-License-Identifier: Apache-2.0
// Opens the store for the rows of a plan.
#pragma once
#include <string>
#include <vector>

#include "faces/cli/plan_reading.hpp"

namespace cli {

/// Opens the store by --store, --resume and --force. `identity` is the text that must not change between two
/// sittings.
base::Result<files::PlanStore> store_of(const RunArguments& arguments, const ReadPlan& plan,
                                        std::string identity);

/// The message after an interrupt that the store keeps the rows, and how to continue; empty without a store.
std::string kept_in(const std::string& store);
/// kept_in(), and the files with partial names; empty if no file remains.
std::string left_behind(const std::vector<std::string>& partial_files, const std::string& store);

/// The unit of a scenario's key; empty if it has none.
std::string unit_of(const std::string& key);

/// A new store, or an existing one to continue; its Problems name these options.
base::Result<files::PlanStore> store_at(const std::string& path, bool resume, bool force,
                                        files::StoredPlan plan);

}  // namespace cli
