// SPDX-License-Identifier: Apache-2.0
// Computes in closed form what each wrong belief of [believed] costs.
#pragma once
#include <string>
#include <vector>

#include "sixstep/study/compile/compile.hpp"

namespace sixstep::study {

/// A sentence for each belief that differs from the truth, and for a sensor's mounting offset that the drive
/// does not subtract. With a subscript m for the motor and f for the firmware:
///   angle d     torque K I cos d, and -I sin d along the magnet
///   pole pairs  Hall speed read p_m/p_f times the speed; an angle from the shaft turns p_f/p_m times too fast
///   R, L        bandwidth, phase margin and slowest pole of the current loop with its gains, before and after
///   K           torque per ampere K_m/K_f, and the highest speed on this bus
///   J           gain of the speed loop J_f/J_m
///   Hall table  codes that the drive assigns to a wrong sector
std::vector<std::string> belief_costs(const Scenario& scenario, const Compiled& compiled);

/// Angle in electrical degrees, -180 to 180, by which the drive's angle exceeds the rotor's by mounting and
/// belief of the sensor in use.
double believed_angle_error_deg(const Scenario& scenario);

}  // namespace sixstep::study
