// SPDX-License-Identifier: Apache-2.0
#include "sixstep/design/loops/settling_limits.hpp"

#include <algorithm>

#include "sixstep/base/angle.hpp"
#include "sixstep/design/loops/design_warnings.hpp"
#include "sixstep/design/loops/loop_figures.hpp"

namespace sixstep::design {
namespace {

constexpr double longest_s = 1000.0;
constexpr int points = 512;  // this number of points suffices, because a PI loop's phase has no narrow
                             // features

bool holds(const SettlingQuestion& q, const RotorSensing& sensing, double speed_rad_s, double settle_s) {
  const plant::Shaft& shaft = q.drive.motor.shaft;
  const ZohPlant plant = speed_plant(q.torque_limit_Nm, shaft.J_kg_m2, shaft.B_Nm_s, q.drive.period_s);
  const base::Result<PolePlacement> placed = place_poles(plant, settle_s, q.damping, q.drive.period_s);
  if (!placed) return false;
  DriveLoops drive = q.drive;
  drive.speed = placed->gains;
  const double crossover = speed_crossover_rad_s(placed->gains.d1, q.torque_limit_Nm / shaft.J_kg_m2);
  const SpeedLag lag = speed_lag(sensing, drive.motor.machine.pole_pairs, speed_rad_s, crossover);
  const LoopFigures f = sensed_figures({open_speed_loop(drive), lag}, drive.period_s, points);
  return f.stable && f.phase_rad && *f.phase_rad * 180 / base::pi >= least_phase_deg;
}

}  // namespace

std::optional<double> fastest_settling_s(const SettlingQuestion& q, const RotorSensing& sensing,
                                         double lowest_speed_rad_s) {
  // The phase margin grows with the settling time. The time is doubled until the loop has enough phase
  // margin, and then bisected to a thousandth.
  double low = 2 * q.drive.period_s, high = 4 * q.drive.period_s;
  while (!holds(q, sensing, lowest_speed_rad_s, high)) {
    low = high;
    high *= 2;
    if (high > longest_s) return std::nullopt;
  }
  while (high - low > 1e-3 * low) {
    const double middle = low + (high - low) / 2;
    (holds(q, sensing, lowest_speed_rad_s, middle) ? high : low) = middle;
  }
  return high;
}

std::vector<SettlingLimit> settling_limits(const SettlingQuestion& question, const RotorSensing& rotor,
                                           const SpeedsToHold& speeds) {
  std::vector<RotorSensing> ways{rotor};
  if (rotor.shaft.kind == ShaftSensorKind::none) ways = {{true, 1}, {true, 6}, {true, 0}};
  std::vector<SettlingLimit> out;
  for (const RotorSensing& sensing : ways)
    for (const double times : {1.0, 2.0, 5.0}) {
      const double speed = times * speeds.lowest;
      if (times > 1.0 && speed > speeds.highest) continue;
      out.push_back({sensing, speed, fastest_settling_s(question, sensing, speed)});
    }
  return out;
}

std::size_t speeds_in(const std::vector<SettlingLimit>& limits) {
  const auto starts_a_way = [&](const SettlingLimit& l) {
    return l.lowest_speed_rad_s == limits.front().lowest_speed_rad_s;
  };
  const auto ways = static_cast<std::size_t>(std::count_if(limits.begin(), limits.end(), starts_a_way));
  return ways > 0 ? limits.size() / ways : 0;
}

}  // namespace sixstep::design
