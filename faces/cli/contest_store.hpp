// SPDX-License-Identifier: Apache-2.0
// The drives of a comparison and the store that their rows go to: the same as a plan's, and resumed like it.
#pragma once
#include <string>

#include "batch/contest.hpp"
#include "faces/cli/rooms.hpp"
#include "files/store/plan_store.hpp"

namespace cli {

struct ContestStoring {
  std::string path;  ///< of the store; empty: one that goes with the program
  bool resume = false, force = false;
  std::string command;
};

/// The store for the drives of these entries. Problems where it is of another comparison.
base::Result<files::PlanStore> store_of(const analysis::Contest& contest, const ContestStoring& storing);

/// Makes the drives that the store has not yet, unless they are stopped, and takes all that it has by then.
base::Problems take_drives(analysis::Contest& contest, batch::ContestOrder order, files::PlanStore& store);

}  // namespace cli
