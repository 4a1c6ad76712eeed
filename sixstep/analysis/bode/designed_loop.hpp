// SPDX-License-Identifier: Apache-2.0
// The linear loop that a scenario's gains make with its motor, as design judges it.
#pragma once
#include <optional>
#include <string>

#include "sixstep/design/loops/rotor_sensing.hpp"
#include "sixstep/design/loops/transfer.hpp"
#include "sixstep/study/compile/compile.hpp"

namespace sixstep::analysis {

struct DesignedLoop {
  std::optional<design::Transfer> loop;  ///< open, of the mode's outermost loop, the inner ones closed within
  std::string not_linear;                ///< else: why there is none
  std::optional<design::SpeedLag> lag;   ///< of the loop's own quantity, where that is a speed from a sensor
};

/// `speed_rad_s`: at which it turns, for what a sensor's lag is.
DesignedLoop designed_loop(const study::Scenario& scenario, const study::Compiled& compiled,
                           double speed_rad_s);

}  // namespace sixstep::analysis
