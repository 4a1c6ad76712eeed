// SPDX-License-Identifier: Apache-2.0
// Finds voltages of a log that cannot belong to one motor: one probe's divider or one column's unit is
// different.
#pragma once
#include "sixstep/analysis/identification/hall/hall_log.hpp"
#include "sixstep/analysis/identification/hall/smooth_motion.hpp"
#include "sixstep/base/problem.hpp"

namespace sixstep::analysis {

/// A Problem if the fundamentals of the three voltages between terminals differ in size over the rotor's
/// path. `edges` is the number of edges that determine the path.
base::Problems check_alike(const HallLog& log, const MotionPath& path, std::size_t edges);

}  // namespace sixstep::analysis
