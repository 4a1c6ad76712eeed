// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "faces/cli/rooms.hpp"
#include "sixstep/analysis/verify/robust.hpp"

namespace cli {

/// Returns a loop that runs pieces of work on up to `jobs` threads (0: one per core) and shows the progress:
/// "7 of 41 points".
analysis::ForEach side_by_side(unsigned jobs, bool quiet, const char* what);

}  // namespace cli
