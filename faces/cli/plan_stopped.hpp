// SPDX-License-Identifier: Apache-2.0
// Runs of a plan in which a controller of one's own has ended the program. Beside the store stands which they were, so that whoever
// goes on with it (--resume) does not come to the same end again.
#pragma once
#include <set>
#include <string>

#include "faces/cli/plan_reading.hpp"
#include "files/store/plan_store.hpp"

namespace cli {

/// From here on such a run is noted beside the store; of one that begins anew what was noted before is forgotten.
void note_stopped_runs(const files::PlanStore& store, bool goes_on);
/// Those of earlier sittings become rows of the store: stopped by a fault, with what happened. Which these are: the rows may still be
/// on their way.
std::set<std::size_t> take_stopped_runs(const ReadPlan& plan, files::PlanStore& store);
/// The rows stand in the store.
void forget_stopped_runs(const files::PlanStore& store);

}  // namespace cli
