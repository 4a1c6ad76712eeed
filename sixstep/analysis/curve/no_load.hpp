// SPDX-License-Identifier: Apache-2.0
// The speed that a motor reaches with nothing on its shaft, found twice: where the curve at held speeds needs
// no torque from outside, and by letting the rotor run.
#pragma once
#include "sixstep/analysis/curve/operating_point.hpp"

namespace sixstep::analysis {

struct NoLoad {
  OperatingPoint point;           ///< at held speed, mean shaft torque 0
  double half_width_rad_s = 0.0;  ///< quasi-periodic: the torque's half width over the curve's slope
  double slope_Nm_s = 0.0;        ///< of the shaft torque over speed there, negative
  double free_speed_rad_s = 0.0;  ///< mean of a free rotor
  double free_winding_current_A = 0.0;
  double free_bus_current_A = 0.0;  ///< likewise
  double time_constant_s = 0.0;     ///< J/|slope|
  double free_s = 0.0;              ///< simulated with the rotor free
  bool settled = true;              ///< false: longest_free_s were too short for that time constant
};

inline constexpr double longest_free_s = 20.0;

/// The free rotor starts at the found speed, runs for 20 time constants J/|slope| and is averaged over two
/// more, within longest_free_s. A Problem where friction holds the rotor, or nothing slows it down.
base::Result<NoLoad> no_load(const Bench& bench);

}  // namespace sixstep::analysis
