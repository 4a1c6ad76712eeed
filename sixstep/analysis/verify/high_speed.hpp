// SPDX-License-Identifier: Apache-2.0
// Tests a speed drive near its highest speed. The usual test runs near the lowest speed, where the measured
// speed is oldest. If the steps of the measured speed grow with the speed, the same test also runs at the
// highest speed.
#pragma once
#include "sixstep/analysis/verify/design_study.hpp"

namespace sixstep::analysis {

/// Tests a design with the warning Concern::grain: runs it up to design.high_speed_rad_s, with its sensors
/// and with ideal sensors. The warning becomes grave if the two speeds differ by more than the settling band.
void look_at_high_speed(const DesignOrder& order, DesignStudy& study);

}  // namespace sixstep::analysis
