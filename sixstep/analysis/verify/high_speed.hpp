// SPDX-License-Identifier: Apache-2.0
// A speed drive's test is run where its sensor's speed is oldest, near its lowest speed. Where a step of the measured speed grows with
// the speed, the highest one is another question: the same test once more, up to it.
#pragma once
#include "sixstep/analysis/verify/design_study.hpp"

namespace sixstep::analysis {

/// Where the design warns of the grain of its speed: runs it up to design.high_speed_rad_s, with its sensors and with ideal ones. The
/// warning is grave where the sensors hold a speed that is off by more than the settling band.
void look_at_high_speed(const DesignOrder& order, DesignStudy& study);

}  // namespace sixstep::analysis
