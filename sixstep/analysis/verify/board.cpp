// SPDX-License-Identifier: Apache-2.0
#include "sixstep/analysis/verify/board.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/decimal.hpp"
#include "sixstep/base/plausible.hpp"

namespace sixstep::analysis {
namespace {

double range_from(double least) { return base::shortened(least, 2, base::Towards::up); }

constexpr double sectors_until_standstill = 20.0;

/// Step of the measured position, in degrees of the motor's shaft; 0: the position has no steps.
double position_step_deg(const design::DriveDesign& d) {
  const design::ShaftSensing& shaft = d.spec.rotor.shaft;
  switch (shaft.kind) {
    case design::ShaftSensorKind::none:
      return d.spec.rotor.hall ? 60.0 / d.motor.machine.pole_pairs : 0.0;
    case design::ShaftSensorKind::encoder:
      return shaft.gear * 360.0 / (4.0 * shaft.lines);
    case design::ShaftSensorKind::absolute:
      return shaft.gear * 360.0 / static_cast<double>(std::uint64_t{1} << shaft.bits);
    case design::ShaftSensorKind::resolver:
      return 0.0;
  }
  return 0.0;
}

}  // namespace

study::RotorSensing rotor_key(const design::RotorSensing& sensing) {
  switch (sensing.shaft.kind) {
    case design::ShaftSensorKind::none:
      break;
    case design::ShaftSensorKind::encoder:
      return study::RotorSensing::encoder;
    case design::ShaftSensorKind::absolute:
      return study::RotorSensing::absolute;
    case design::ShaftSensorKind::resolver:
      return study::RotorSensing::resolver;
  }
  return sensing.hall ? study::RotorSensing::hall : study::RotorSensing::ideal;
}

study::Sensors with_rotor(study::Sensors s, study::RotorSensing rotor, double period_s) {
  s.rotor = rotor;
  if (rotor == study::RotorSensing::ideal || rotor == study::RotorSensing::hall)
    s.shaft = study::SensorShaft::motor;
  if (rotor == study::RotorSensing::resolver && s.resolver.reading == rig::ResolverReading::sampled) {
    const double half_periods = std::max(std::round(0.5 / s.resolver.excitation_Hz / period_s), 1.0);
    s.resolver.excitation_Hz = 0.5 / (half_periods * period_s);
  }
  return s;
}

study::Sensors board_sensors(const design::DriveDesign& d, std::optional<double> step) {
  study::Sensors s;
  if (!d.spec.rotor.lags()) return s;
  sense_currents(d, rig::CurrentMeasurement::phases, step, s);
  s.bus = study::BusSensing::adc;
  s.bus_range_V = std::min(range_from(1.5 * d.bus_V), base::plausible("V").most);
  s = with_rotor(s, rotor_key(d.spec.rotor), d.spec.period_s);
  if (!d.spec.rotor.hall) return s;
  s.speed_edges = d.spec.rotor.edges;
  const double sector_s = base::pi / 3 / d.motor.machine.pole_pairs / d.lowest_speed_rad_s;
  s.timeout_s = std::max(s.timeout_s, range_from(sectors_until_standstill * sector_s));
  return s;
}

namespace {

/// Largest current in A that a drive requests, for a current loop with the overshoot of the given step.
double measured_current_A(const design::DriveDesign& d, std::optional<double> step) {
  if (d.spec.mode != control::Mode::current) return d.current_at_full_torque_A;
  const double usual = design::usual_overload * d.nominal_current_A;
  const double overshoot = d.loop("current").step.overshoot;
  return step ? std::max(usual, std::fabs(*step) * (1 + (std::isfinite(overshoot) ? overshoot : 0.0)))
              : usual;
}

}  // namespace

void sense_currents(const design::DriveDesign& d, rig::CurrentMeasurement currents,
                    std::optional<double> step, study::Sensors& s) {
  s.currents = currents;
  if (currents == rig::CurrentMeasurement::ideal || s.current_range_A) return;
  const double headroom = d.spec.mode == control::Mode::position ? 2.0 : 1.25;
  s.current_range_A = range_from(headroom * (measured_current_A(d, step) + d.ripple.worst_A));
}

study::Scenario with_ideal_sensors(study::Scenario scenario) {
  scenario.sensors = {};
  return scenario;
}

bool decodes_encoders(const std::optional<study::Scenario>& board) {
  using enum study::FirmwareKind;
  return !board || (board->control.drive != product && board->control.drive != sensorless);
}

std::optional<double> most_current_A(const study::Scenario& board, double K_t_Nm_A) {
  const study::Limits& l = board.control.limits;
  std::optional<double> most = l.current_A;
  if (l.torque_Nm) most = std::min(*l.torque_Nm / K_t_Nm_A, most.value_or(*l.torque_Nm / K_t_Nm_A));
  return most;
}

std::optional<double> most_speed_rad_s(const study::Scenario& board) {
  constexpr double below_a_trip = 0.9;
  std::optional<double> most = board.control.limits.speed_rad_s;
  const std::optional<double>& trip = board.protection.over_speed_rad_s;
  if (board.control.drive == study::FirmwareKind::product && trip)
    most = std::min(below_a_trip * *trip, most.value_or(below_a_trip * *trip));
  return most;
}

double allowed_swing_rad_s(double with_ideal_sensors_rad_s, double speed_rad_s) {
  return std::max(3 * with_ideal_sensors_rad_s, std::fabs(speed_rad_s) / 20);
}

double allowed_overshoot_deg(const design::DriveDesign& d, double move_deg) {
  return std::max(std::fabs(move_deg) / 100, 3 * position_step_deg(d));
}

}  // namespace sixstep::analysis
