// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/verify/travel.hpp"

#include <algorithm>
#include <cmath>

namespace sixstep::analysis {
namespace {

/// Torque in N m towards a speed. If `faster`: the torque limit, or the torque that the bus drives at this
/// speed if it is less. Otherwise the braking torque in addition to the load; soft chopping brakes through
/// the lower switches.
double torque_towards(const design::DriveDesign& d, double rad_s, bool faster) {
  const double K = d.motor.K_t_Nm_A, R = 2 * d.motor.machine.R_ohm;
  if (faster) return std::min(d.most_torque_Nm(), K * (d.bus_V - K * rad_s) / R);
  const double shorted = d.spec.chopping == control::Chopping::soft ? K * K * rad_s / R : d.most_torque_Nm();
  return std::min(d.most_torque_Nm(), shorted);
}

}  // namespace

double start_time(const design::DriveDesign& d, double to_rad_s, double load_Nm) {
  const double K = d.motor.K_t_Nm_A, R = 2 * d.motor.machine.R_ohm;
  const double by_bus = K * (d.bus_V - K * to_rad_s) / R,
               torque = std::min(d.most_torque_Nm(), by_bus) - load_Nm;
  return torque > 0.0 ? d.motor.shaft.J_kg_m2 * to_rad_s / torque : 0.0;
}

double travel_time(const design::DriveDesign& d, double from_rad_s, double to_rad_s, double load_Nm) {
  constexpr int parts = 100;
  const double K = d.motor.K_t_Nm_A, R = 2 * d.motor.machine.R_ohm, J = d.motor.shaft.J_kg_m2;
  const double part = std::fabs(to_rad_s - from_rad_s) / parts, creep = J * R / (K * K);
  const bool faster = std::fabs(to_rad_s) > std::fabs(from_rad_s);
  double time = 0.0;
  for (int n = 0; n < parts; ++n) {
    const double speed = std::fabs(from_rad_s + (n + 0.5) / parts * (to_rad_s - from_rad_s));
    const double torque = torque_towards(d, speed, faster) + (faster ? -load_Nm : load_Nm);
    if (!(torque > 0.01 * d.most_torque_Nm())) return time + 5 * creep;
    time += J * part / torque;
  }
  return time;
}

}  // namespace sixstep::analysis
