// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/operating_range.hpp"

#include <algorithm>
#include <cmath>

namespace sixstep::study {

namespace {

constexpr double degrees_per_radian = 180 / 3.14159265358979323846;

double largest_load_Nm(const Load& load) {
  double most = std::fabs(load.torque_Nm);
  for (const double torque : load.torques_Nm) most = std::max(most, std::fabs(torque));
  return most;
}

}  // namespace

design::OperatingRange operating_range(const Scenario& s, const Compiled& c) {
  const double R_tt = 2 * c.motor.machine.R_ohm, K_t = c.motor.K_t_Nm_A;
  design::OperatingRange range;
  range.bus_V = std::max(c.supply.V_0_V, c.start.bus_V);
  range.speed_rad_s =
      std::max(std::fabs(c.start.speed_rad_s), (range.bus_V + R_tt * largest_load_Nm(s.load) / K_t) / K_t);
  range.current_A = (range.bus_V + 2 * c.motor.machine.K_e_V_s * range.speed_rad_s) / R_tt;
  for (const Level& level : reference_levels(s.reference, s.duration_s))
    range.setpoint = std::max(range.setpoint, std::fabs(level.value));
  if (c.drive.mode == control::Mode::position) {
    const double torque = K_t * std::min(c.drive.current_limit_A, c.drive.current_at_full_torque_A);
    const double w = std::min(c.drive.speed_limit_rad_s, range.speed_rad_s);
    const double stopping_rad = torque > 0 ? c.shaft.J_kg_m2 * w * w / (2 * torque) : 0.0;
    range.position_deg = range.setpoint + (std::fabs(c.start.angle_rad) + stopping_rad) * degrees_per_radian;
  }
  return range;
}

}  // namespace sixstep::study
