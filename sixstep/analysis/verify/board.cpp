// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/verify/board.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/decimal.hpp"
#include "sixstep/base/plausible.hpp"

namespace sixstep::analysis {
namespace {

double range_from(double least) { return base::shortened(least, 2, base::Towards::up); }

constexpr double sectors_until_standstill = 20.0;

}  // namespace

study::Sensors board_sensors(const design::DriveDesign& d) {
  study::Sensors s;
  if (!d.spec.rotor.hall) return s;
  sense_currents(d, rig::CurrentMeasurement::phases, s);
  s.bus = study::BusSensing::adc;
  s.bus_range_V = std::min(range_from(1.5 * d.bus_V), base::plausible("V").most);
  s.rotor = study::RotorSensing::hall;
  s.speed_edges = d.spec.rotor.edges;
  const double sector_s = base::pi / 3 / d.motor.machine.pole_pairs / d.lowest_speed_rad_s;
  s.timeout_s = std::max(s.timeout_s, range_from(sectors_until_standstill * sector_s));
  return s;
}

void sense_currents(const design::DriveDesign& d, rig::CurrentMeasurement currents, study::Sensors& s) {
  s.currents = currents;
  if (currents == rig::CurrentMeasurement::ideal || s.current_range_A) return;
  const double most_A = d.spec.mode == control::Mode::current ? design::usual_overload * d.nominal_current_A
                                                              : d.current_at_full_torque_A;
  s.current_range_A = range_from(1.25 * (most_A + d.ripple.worst_A));
}

study::Scenario with_ideal_sensors(study::Scenario scenario) {
  scenario.sensors = {};
  return scenario;
}

double allowed_swing_rad_s(double with_ideal_sensors_rad_s, double speed_rad_s) {
  return std::max(3 * with_ideal_sensors_rad_s, std::fabs(speed_rad_s) / 20);
}

double allowed_overshoot_deg(const design::DriveDesign& d, double move_deg) {
  const double part = std::fabs(move_deg) / 100;
  return d.spec.rotor.hall ? std::max(part, 3 * 60.0 / d.motor.machine.pole_pairs) : part;
}

}  // namespace sixstep::analysis
