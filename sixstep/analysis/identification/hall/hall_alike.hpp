// SPDX-License-Identifier: Apache-2.0
// Voltages of a log that are not those of one motor: a probe's divider or a column's unit is another than that of the rest.
#pragma once
#include "sixstep/analysis/identification/hall/hall_log.hpp"
#include "sixstep/analysis/identification/hall/smooth_motion.hpp"
#include "sixstep/base/problem.hpp"

namespace sixstep::analysis {

/// Whether the three voltages between terminals have fundamentals of one size over the rotor's way, `edges` of which say where it is.
base::Problems check_alike(const HallLog& log, const MotionPath& path, std::size_t edges);

}  // namespace sixstep::analysis
