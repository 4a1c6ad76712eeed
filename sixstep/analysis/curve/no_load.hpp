// SPDX-License-Identifier: Apache-2.0
// Finds the no-load speed of a motor in two ways: as the imposed speed at which the shaft needs no external
// torque, and as the speed of a free rotor.
#pragma once
#include "sixstep/analysis/curve/operating_point.hpp"

namespace sixstep::analysis {

struct NoLoad {
  OperatingPoint point;           ///< the point at the imposed speed with mean shaft torque 0
  double half_width_rad_s = 0.0;  ///< quasi-periodic orbit: the torque's half width divided by the slope
  double slope_Nm_s = 0.0;        ///< slope of the shaft torque over speed at that point, negative
  double free_speed_rad_s = 0.0;  ///< mean of a free rotor
  double free_winding_current_A = 0.0;
  double free_bus_current_A = 0.0;  ///< mean of a free rotor
  double time_constant_s = 0.0;     ///< J/|slope|
  double free_s = 0.0;              ///< simulated time with the rotor free
  bool settled = true;              ///< false: longest_free_s is too short for this time constant
};

inline constexpr double longest_free_s = 20.0;

/// Finds the no-load point. A free rotor then starts at the no-load speed, runs for 20 time constants
/// J/|slope|, and is averaged over two more time constants, within longest_free_s. Returns a Problem if
/// friction prevents the rotation, or if no torque slows the rotor down.
base::Result<NoLoad> no_load(const Bench& bench);

}  // namespace sixstep::analysis
