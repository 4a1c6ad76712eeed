// SPDX-License-Identifier: Apache-2.0
// The load at the shaft. load_description.hpp describes each key.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace sixstep::study {

/// Interpolation between the points of a table over time.
enum class Between : std::uint8_t { steps, lines };

struct Load {
  double torque_Nm = 0.0;
  std::vector<double> times_s;  // with steps: torques_Nm[n] applies from times_s[n] on
  std::vector<double> torques_Nm;
  Between between = Between::steps;
  std::vector<double> at_speeds_rad_s, at_speeds_Nm;           // table of torque over the load's speed
  std::vector<double> dynamometer_times_s, dynamometer_rad_s;  // table of the load's imposed speed over time
  double viscous_Nm_s = 0.0;                                   // added to the motor's own friction
  double coulomb_Nm = 0.0;
  double static_Nm = 0.0;  // breakaway torque; acts only if larger than coulomb_Nm
  double inertia_kg_m2 = 0.0;
  double gear_efficiency = 1.0;
  double gear = 1.0;              // motor turns per load turn; the load's values refer to the load's shaft
  double stiffness_Nm_rad = 0.0;  // of the shaft between motor and load; 0: rigid
  double damping_Nm_s_rad = 0.0;
  double fan_Nm_s2 = 0.0;  // torque per square of the load's speed
  double gravity_Nm = 0.0;
  double gravity_angle_deg = 0.0;
  bool locked = false;
};

/// The coefficient of a load torque that grows with the square of the load's speed and opposes it, and the
/// key that gives the coefficient. Check, plant, report and exported header all call square_law(). Another
/// load of this law, such as a propeller given by its diameter, is therefore added in this file and in
/// load_description.hpp only.
struct SquareLaw {
  double Nm_s2 = 0.0;
  std::string key;
};
inline SquareLaw square_law(const Load& load) { return {load.fan_Nm_s2, "load.fan_Nm_s2"}; }

}  // namespace sixstep::study
