// SPDX-License-Identifier: Apache-2.0
// How fast a speed loop may be for the sensor that it has and the lowest speed that it is to hold.
#pragma once
#include <optional>
#include <vector>

#include "sixstep/design/loops/drive_loops.hpp"
#include "sixstep/design/loops/rotor_sensing.hpp"

namespace sixstep::design {

/// A speed loop by pole placement around a current loop; `drive` has that one's gains, delay and period.
struct SettlingQuestion {
  DriveLoops drive;
  double torque_limit_Nm = 0.0;
  double damping = usual_damping;
};

/// The shortest settling time whose loop keeps least_phase_deg with the sensor's lag at the lowest speed. It
/// is a loop that holds; a third of it keeps nothing. Empty: none up to 1000 s does.
std::optional<double> fastest_settling_s(const SettlingQuestion& question, const RotorSensing& sensing,
                                         double lowest_speed_rad_s);

struct SettlingLimit {
  RotorSensing sensing;
  double lowest_speed_rad_s = 0.0;
  std::optional<double> settle_s;
};
/// For Hall probes with one edge, with six and adaptive, or for the encoder or resolver that there is, down to the
/// lowest speed and to twice and five times it.
std::vector<SettlingLimit> settling_limits(const SettlingQuestion& question, const RotorSensing& rotor,
                                           double lowest_speed_rad_s);

}  // namespace sixstep::design
