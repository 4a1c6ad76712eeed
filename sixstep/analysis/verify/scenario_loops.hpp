// SPDX-License-Identifier: Apache-2.0
// Computes the loops from a scenario's gains and motor, in the form of the design.
#pragma once
#include "sixstep/design/loops/drive_loops.hpp"
#include "sixstep/study/compile/compile.hpp"

namespace sixstep::analysis {

/// The loops of the configuration at the end of the run, on the simulated motor. For a field-oriented drive
/// they are the loops of the axis across the magnet.
design::DriveLoops loops_of(const study::Scenario& scenario, const study::Compiled& compiled);

/// The same loops on the motor that the drive believes, for which its gains are designed.
design::DriveLoops believed_loops_of(const study::Scenario& scenario, const study::Compiled& compiled);

}  // namespace sixstep::analysis
