// SPDX-License-Identifier: Apache-2.0
// Reads the recordings that [[compare]] names.
#pragma once
#include "sixstep/study/scenario/scenario.hpp"
#include "text/rooms.hpp"
#include "text/sources.hpp"
#include "text/toml/complaints.hpp"

namespace text {

/// Moves the comparisons with a file to scenario.recordings and reads their rows.
void read_recordings(const Document& document, const Resolve& resolve, study::Scenario& scenario,
                     Complaints& complaints, base::Problems& of_other_files);

}  // namespace text
