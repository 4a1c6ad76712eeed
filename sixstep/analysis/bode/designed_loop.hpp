// SPDX-License-Identifier: Apache-2.0
// Builds the linear loop of a scenario's gains and its motor, with the design's equations.
#pragma once
#include <optional>
#include <string>

#include "sixstep/design/loops/rotor_sensing.hpp"
#include "sixstep/design/loops/transfer.hpp"
#include "sixstep/study/compile/compile.hpp"

namespace sixstep::analysis {

struct DesignedLoop {
  std::optional<design::Transfer> loop;  ///< open loop of the mode's outermost controller, with closed inner
                                         ///< loops
  std::string not_linear;                ///< why `loop` is empty
  std::optional<design::SpeedLag> lag;   ///< delay of the measured speed by the sensor, in speed mode; empty:
                                         ///< no delay
};

/// `speed_rad_s`: the speed at which the sensor's lag is computed; 0: no lag.
DesignedLoop designed_loop(const study::Scenario& scenario, const study::Compiled& compiled,
                           double speed_rad_s);

}  // namespace sixstep::analysis
