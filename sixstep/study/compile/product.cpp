// SPDX-License-Identifier: Apache-2.0
// Configures a scenario's product drive: converters and capture from [sensors], thresholds from [protection].
#include <algorithm>
#include <cmath>
#include <limits>

#include "sixstep/base/angle.hpp"
#include "sixstep/study/compile/basis.hpp"

namespace sixstep::study {

namespace {

std::uint32_t periods(double seconds, double period_s) {
  const double n = std::floor(seconds / period_s + 0.5);
  return static_cast<std::uint32_t>(std::min(n, 4e9));
}

control::AdcConfig<double> decoded(const rig::AdcPath& path, double tolerance) {
  return {
      .per_eighth = path.lsb() / 8,
      .offset_counts = path.zero(),
      .offset_tolerance = static_cast<std::uint16_t>(std::min(std::ceil(tolerance / path.lsb()), 65535.0))};
}

/// Resolution of an edge's time in timer counts: 1 if the timer captures edges, else the counts of a control
/// period.
std::uint32_t edge_grain(const Scenario& s) {
  const bool captured = s.pwm.commutation == CommutationAt::hall_edge && s.sensors.hall_stable_samples <= 1;
  if (captured) return 1;
  return static_cast<std::uint32_t>(std::min(std::ceil(s.pwm.period_s * s.sensors.capture_Hz), 4e9));
}

control::FaultConfig<double> faults_of(const Scenario& s) {
  const Protection& p = s.protection;
  const bool watches_stall = p.stall_current_A && p.stall_s;
  return {.over_current_A = p.over_current_A.value_or(0.0),
          .over_voltage_V = p.over_voltage_V.value_or(0.0),
          .under_voltage_V = p.under_voltage_V.value_or(0.0),
          .over_speed_rad_s = p.over_speed_rad_s.value_or(0.0),
          .stall_current_A = watches_stall ? *p.stall_current_A : p.over_current_A.value_or(0.0),
          .stall_ticks =
              watches_stall ? periods(*p.stall_s, s.pwm.period_s) : std::numeric_limits<std::uint32_t>::max(),
          .voltage_ticks = static_cast<std::uint8_t>(p.voltage_samples)};
}

/// Converts electrical degrees to sectors of 60 degrees.
control::AdvanceConfig<double> advance_of(const Advance& a) {
  if (!advances(a)) return {};
  return {a.angle_deg / 60, a.gain_deg_s_per_rad / 60, a.limit_deg / 60};
}

}  // namespace

control::ProtectedConfig<double> product_around(const Scenario& s, const Basis& basis,
                                                const control::DriveConfig<double>& drive,
                                                const rig::SensorsConfig& sensors) {
  const Protection& p = s.protection;
  const double pole_pairs = basis.motor.machine.pole_pairs, R = 2 * basis.motor.machine.R_ohm;
  const double tolerance_A = p.offset_tolerance_A.value_or(0.02 * sensors.current.range);
  const double sector_deg = 60.0 / pole_pairs;
  control::ProtectedConfig<double> c;
  c.drive = drive;
  c.setpoint_limit = largest_reference(s);
  c.sensing = sensors.currents == rig::CurrentMeasurement::dc_link ? control::CurrentSensing::one_shunt
                                                                   : control::CurrentSensing::phases;
  for (control::AdcConfig<double>& adc : c.current_adc) adc = decoded(sensors.current, tolerance_A);
  c.bus_adc = decoded(sensors.bus, 0.0);
  c.shunt = {sensors.least_duty, sensors.commutation_samples, sensors.fade};
  c.speed = {base::pi / 3 / pole_pairs * sensors.capture_Hz,
             static_cast<std::uint32_t>(sensors.timeout_s * sensors.capture_Hz), sensors.edges,
             rig::window_ticks(sensors), edge_grain(s)};
  c.position = {sector_deg, sector_deg};
  c.hall.arrangement = s.sensors.hall_spacing;
  c.hall.stable_samples = static_cast<std::uint8_t>(s.sensors.hall_stable_samples);
  c.advance = advance_of(s.control.advance);
  c.faults = faults_of(s);
  if (p.align.current_A)
    c.align = {.current_A = *p.align.current_A,
               .ticks = std::max(1u, periods(p.align.longest_s, s.pwm.period_s)),
               .settled_ticks = periods(p.align.settled_s, s.pwm.period_s),
               .sector = static_cast<std::uint8_t>(p.align.sector)};
  c.brake_current_A = p.brake_current_A;
  c.short_below_rad_s = p.short_below_rad_s.value_or(p.brake_current_A * R / basis.motor.K_t_Nm_A);
  c.standing_rad_s = p.standing_rad_s;
  return c;
}

}  // namespace sixstep::study
