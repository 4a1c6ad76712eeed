// SPDX-License-Identifier: Apache-2.0
// Stores the drives of a comparison like the runs of a plan, and resumes them in the same way.
#pragma once
#include <string>

#include "batch/contest.hpp"
#include "faces/cli/rooms.hpp"
#include "files/store/plan_store.hpp"

namespace cli {

struct ContestStoring {
  std::string path;  ///< path of the store; empty: a temporary store, removed at the program's end
  bool resume = false, force = false;
  std::string command;
};

/// Opens the store for the drives of these entries. Problem: the store contains another comparison.
base::Result<files::PlanStore> store_of(const analysis::Contest& contest, const ContestStoring& storing);

/// Runs the drives that are not in the store, until all are run or the program is interrupted. Then reads all
/// drives from the store.
base::Problems take_drives(analysis::Contest& contest, batch::ContestOrder order, files::PlanStore& store);

}  // namespace cli
