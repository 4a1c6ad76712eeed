// SPDX-License-Identifier: Apache-2.0
// What the shaft has to turn. What each key means stands in load_description.hpp.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace sixstep::study {

/// How a table over time goes from one of its points to the next.
enum class Between : std::uint8_t { steps, lines };

struct Load {
  double torque_Nm = 0.0;
  std::vector<double> times_s;  // steps: torques_Nm[n] holds from times_s[n] on
  std::vector<double> torques_Nm;
  Between between = Between::steps;
  std::vector<double> at_speeds_rad_s, at_speeds_Nm;           // torque over the load's speed
  std::vector<double> dynamometer_times_s, dynamometer_rad_s;  // the load's speed, imposed
  double viscous_Nm_s = 0.0;                                   // added to the motor's own friction
  double coulomb_Nm = 0.0;
  double static_Nm = 0.0;  // breakaway torque where larger than coulomb
  double inertia_kg_m2 = 0.0;
  double gear_efficiency = 1.0;
  double gear = 1.0;              // motor turns per load turn; what the load is given in is at its own side
  double stiffness_Nm_rad = 0.0;  // of the shaft to the load; 0: rigid
  double damping_Nm_s_rad = 0.0;
  double fan_Nm_s2 = 0.0;  // torque per square of the load's speed
  double gravity_Nm = 0.0;
  double gravity_angle_deg = 0.0;
  bool locked = false;
};

/// Torque per square of the load's speed, against it, and the key that gives it. Check, plant, report and header ask here: another load
/// of that law, as a propeller by its diameter, is added in this file and in load_description.hpp.
struct SquareLaw {
  double Nm_s2 = 0.0;
  std::string key;
};
inline SquareLaw square_law(const Load& load) { return {load.fan_Nm_s2, "load.fan_Nm_s2"}; }

}  // namespace sixstep::study
