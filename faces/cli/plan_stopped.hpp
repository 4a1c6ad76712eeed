// SPDX-License-Identifier: Apache-2.0
// Handles runs of a plan in which a user's controller ended the program. A file in the store's folder lists
// these runs, so that --resume does not fail at the same run again.
#pragma once
#include <set>
#include <string>

#include "faces/cli/plan_reading.hpp"
#include "files/store/plan_store.hpp"

namespace cli {

/// Starts to note such runs in the store's folder. If the plan starts anew (`goes_on` false), deletes earlier
/// notes.
void note_stopped_runs(const files::PlanStore& store, bool goes_on);
/// Stores a row, stopped by a fault with the reason, for each run noted by earlier calls of the program.
/// Returns the numbers of these runs, because the rows may not be in the file yet.
std::set<std::size_t> take_stopped_runs(const ReadPlan& plan, files::PlanStore& store);
/// Deletes the notes. Must be called after the rows are in the store.
void forget_stopped_runs(const files::PlanStore& store);

}  // namespace cli
