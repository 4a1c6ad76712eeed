// SPDX-License-Identifier: Apache-2.0
// A design's drawings: step, Bode, headroom over speed, ripple over duty.
#pragma once
#include <string>

#include "sixstep/analysis/verify/design_study.hpp"

namespace report {

/// What was designed over what the simulation recorded, and the current of it.
std::string step_charts(const sixstep::analysis::DesignStudy& study);
/// |L| and its phase of each loop, with the delay that was asked for.
std::string loop_charts(const sixstep::analysis::DesignStudy& study);
std::string limit_charts(const sixstep::analysis::DesignStudy& study);

}  // namespace report
