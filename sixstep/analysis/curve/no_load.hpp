// SPDX-License-Identifier: Apache-2.0
// Finds the no-load speed of a motor in two ways: as the held speed at which the shaft needs no torque from
// outside, and by a free rotor.
#pragma once
#include "sixstep/analysis/curve/operating_point.hpp"

namespace sixstep::analysis {

struct NoLoad {
  OperatingPoint point;           ///< at a held speed, with mean shaft torque 0
  double half_width_rad_s = 0.0;  ///< quasi-periodic: the torque's half width over the slope
  double slope_Nm_s = 0.0;        ///< slope of the shaft torque over speed at that point, negative
  double free_speed_rad_s = 0.0;  ///< mean of a free rotor
  double free_winding_current_A = 0.0;
  double free_bus_current_A = 0.0;  ///< mean of a free rotor
  double time_constant_s = 0.0;     ///< J/|slope|
  double free_s = 0.0;              ///< simulated time with the rotor free
  bool settled = true;              ///< false: longest_free_s is too short for this time constant
};

inline constexpr double longest_free_s = 20.0;

/// Finds the no-load point. A free rotor then starts at that speed, runs for 20 time constants J/|slope| and
/// is averaged over two more, within longest_free_s. A Problem if friction holds the rotor, or if nothing
/// slows it down.
base::Result<NoLoad> no_load(const Bench& bench);

}  // namespace sixstep::analysis
