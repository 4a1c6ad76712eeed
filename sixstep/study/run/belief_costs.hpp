// SPDX-License-Identifier: Apache-2.0
// Computes in closed form what each wrong belief of [believed] costs.
#pragma once
#include <string>
#include <vector>

#include "sixstep/study/compile/compile.hpp"

namespace sixstep::study {

struct BeliefCost {
  std::string text;
  bool grave =
      false;  ///< the drive cannot work with it: no torque in the mean, torque of the wrong sign, or an
              ///< unstable loop
};

/// A sentence for each belief that differs from the truth and acts, and for a sensor's mounting offset that the drive
/// does not subtract. With a subscript m for the motor and f for the firmware:
///   angle d     torque K I cos d, and -I sin d along the magnet
///   pole pairs  Hall speed read p_m/p_f times the speed; an angle from the shaft turns p_f/p_m times too fast
///   R, L        overshoot, bandwidth and phase margin of the current loop with its gains; the flux observer's angle
///   K           torque per ampere K_m/K_f, and the speed at which the bus ends
///   J           inertia of rotor and load
///   J, K, p     gain of the speed loop, J_f/J_m K_m/K_f p_m/p_f
///   Hall table  codes that the drive takes for another sector, and the torque there
std::vector<BeliefCost> belief_costs(const Scenario& scenario, const Compiled& compiled);

/// Angle in electrical degrees, -180 to 180, by which the drive's angle exceeds the rotor's by mounting and
/// belief of the sensor in use.
double believed_angle_error_deg(const Scenario& scenario);

}  // namespace sixstep::study
