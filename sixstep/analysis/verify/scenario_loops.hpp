// SPDX-License-Identifier: Apache-2.0
// The loops that a scenario's gains make with its motor, as design looks at them.
#pragma once
#include "sixstep/design/loops/drive_loops.hpp"
#include "sixstep/study/compile/compile.hpp"

namespace sixstep::analysis {

/// With the configuration that is in effect at the end of the run; of a field-oriented drive with the axis across the magnet.
design::DriveLoops loops_of(const study::Scenario& scenario, const study::Compiled& compiled);

}  // namespace sixstep::analysis
