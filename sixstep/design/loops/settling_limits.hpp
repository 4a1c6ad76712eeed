// SPDX-License-Identifier: Apache-2.0
// Computes how fast a speed loop may be with the lag of its sensor at the lowest required speed.
#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "sixstep/design/loops/drive_loops.hpp"
#include "sixstep/design/loops/rotor_sensing.hpp"

namespace sixstep::design {

/// A speed loop by pole placement around a current loop. `drive` contains the current loop's gains, delay and
/// period.
struct SettlingQuestion {
  DriveLoops drive;
  double torque_limit_Nm = 0.0;
  double damping = usual_damping;
};

/// The shortest settling time, s, for which the loop has the phase margin least_phase_deg with the sensor's
/// lag at the lowest speed. Such a loop is stable; with a third of this time the loop would have no margin.
/// Empty if no time up to 1000 s suffices.
std::optional<double> fastest_settling_s(const SettlingQuestion& question, const RotorSensing& sensing,
                                         double lowest_speed_rad_s);

struct SettlingLimit {
  RotorSensing sensing;
  double lowest_speed_rad_s = 0.0;
  std::optional<double> settle_s;
};
/// Lowest required speeds for the table, rad/s: `lowest`, and twice and five times `lowest`, if they are at
/// most `highest`.
struct SpeedsToHold {
  double lowest = 0.0, highest = 0.0;
};

/// Limits for each kind of sensing and each speed, one kind after the other. The kinds are Hall probes with
/// one edge, with six edges and with an adaptive number, or the given encoder or resolver.
std::vector<SettlingLimit> settling_limits(const SettlingQuestion& question, const RotorSensing& rotor,
                                           const SpeedsToHold& speeds);
/// Number of speeds for each kind of sensing.
std::size_t speeds_in(const std::vector<SettlingLimit>& limits);

}  // namespace sixstep::design
