// SPDX-License-Identifier: Apache-2.0
// How fast a speed loop may be for the sensor that it has and the lowest speed that it is to hold.
#pragma once
#include <cstddef>
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
/// Speeds that a drive may have to hold at the least, in rad/s. The second and third are twice and five times the first, where they are
/// no more than `highest`.
struct SpeedsToHold {
  double lowest = 0.0, highest = 0.0;
};

/// For Hall probes with one edge, with six and adaptive, or for the encoder or resolver that there is: each way of sensing with every
/// speed, one way after the other.
std::vector<SettlingLimit> settling_limits(const SettlingQuestion& question, const RotorSensing& rotor,
                                           const SpeedsToHold& speeds);
/// How many speeds each way of sensing has in them.
std::size_t speeds_in(const std::vector<SettlingLimit>& limits);

}  // namespace sixstep::design
