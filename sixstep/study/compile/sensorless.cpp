// SPDX-License-Identifier: Apache-2.0
// Configures a scenario's sensorless drive: board and motor as given, all other numbers from design/loops/.
#include <algorithm>
#include <cmath>

#include "sixstep/design/loops/pulse_start.hpp"
#include "sixstep/design/loops/sensorless_observer.hpp"
#include "sixstep/study/compile/basis.hpp"
#include "sixstep/study/compile/front_end.hpp"
#include "sixstep/study/compile/pulse.hpp"

namespace sixstep::study {

namespace {

design::ComparatorSpec comparators_of(const Comparators& from) {
  design::ComparatorSpec to{.followed = true,
                            .bandwidth_Hz = from.bandwidth_Hz.value_or(0.0),
                            .against_half_bus = from.against == rig::CrossingReference::half_bus,
                            .hysteresis_V = from.hysteresis_V};
  for (const double offset_V : from.offset_V) to.offset_V = std::max(to.offset_V, std::fabs(offset_V));
  return to;
}

design::SensorlessSpec spec_of(const Scenario& s, const Basis& basis,
                               const control::DriveConfig<double>& drive) {
  const Sensorless& wanted = s.control.sensorless;
  design::SensorlessSpec spec;
  spec.bus_V = basis.bus_V;
  spec.period_s = s.pwm.period_s;
  spec.capture_Hz = s.sensors.capture_Hz;
  spec.adc_bits = s.sensors.adc_bits;
  spec.adc_range_V = s.sensors.bus_range_V.value_or(0.0);
  spec.adc_noise_V = s.sensors.bus_noise_V;
  spec.mismatch = wanted.mismatch;
  spec.greatest_load = wanted.greatest_load;
  spec.overload = wanted.overload;
  spec.lowest_part = wanted.lowest_part;
  spec.advance_deg = wanted.advance_deg;
  spec.pulse_late_s = pulse_late_s(s);
  spec.blanking_s = wanted.blanking_s;
  spec.terminal_bandwidth_Hz = s.sensors.bus_bandwidth_Hz.value_or(0.0);
  spec.speed_window_s = speed_window_s(s, basis, drive);
  spec.chopping = s.pwm.chopping;
  spec.diode_V = s.bridge.diode_drop_V;
  spec.catches_spin = wanted.catches_spin;
  if (wanted.follows == control::Follow::comparators)
    spec.comparators = comparators_of(s.sensors.comparators);
  return spec;
}

design::PulseSpec pulse_spec_of(const Scenario& s, const Basis& basis, double start_A) {
  const design::Sheet& sheet = basis.sheet;
  const bool salient = design::is_salient(sheet);
  design::PulseSpec spec;
  spec.bus_V = basis.bus_V;
  spec.period_s = s.pwm.period_s;
  spec.delay_periods = s.pwm.delay_periods;
  spec.L_d_H = salient ? 1e-3 * sheet.d_axis_inductance_mH->value : basis.motor.machine.L_H;
  spec.L_q_H = salient ? 1e-3 * sheet.q_axis_inductance_mH->value : basis.motor.machine.L_H;
  spec.saturation_A = sheet.saturation_current_A ? sheet.saturation_current_A->value : 0.0;
  spec.most_A = start_A;
  spec.adc_bits = s.sensors.adc_bits;
  spec.current_range_A = s.sensors.current_range_A.value_or(0.0);
  spec.offset_A = s.sensors.current_offset_A;
  spec.noise_A = s.sensors.current_noise_A;
  spec.late_s = lag_s(s.sensors.current_bandwidth_Hz) + s.sensors.current_delay_s;
  return spec;
}

/// Renames problems: the design rule names its own quantities, but a user's file has the scenario's keys.
base::Problems under_their_keys(const base::Problems& problems) {
  constexpr std::pair<const char*, const char*> keys[] = {
      {"greatest_load", "control.sensorless.greatest_load"},
      {"overload", "control.sensorless.overload"},
      {"current_range_A", "sensors.current_range_A"},
      {"adc_noise_V", "sensors.bus_noise_V"},
      {"adc_bits", "sensors.adc_bits"},
      {"terminal_bandwidth_Hz", "sensors.bus_bandwidth_Hz"},
      {"capture_Hz", "sensors.capture_Hz"},
      {"comparators", "sensors.comparators"},
      {"comparators.bandwidth_Hz", "sensors.comparators.bandwidth_Hz"},
      {"bus_V", "supply.voltage_V"},
      {"period_s", "pwm.period_s"}};
  base::Problems out = problems;
  for (base::Problem& p : out)
    for (const auto& [own, key] : keys)
      if (p.where == own) p.where = key;
  return out;
}

}  // namespace

base::Result<SensorlessAround> sensorless_around(const Scenario& s, const Basis& basis,
                                                 const control::DriveConfig<double>& drive) {
  design::MotorModel motor = basis.motor;
  motor.shaft = basis.shaft;
  const design::SensorlessSpec spec = spec_of(s, basis, drive);
  const auto start = design::sensorless_start(motor, spec, drive.current_at_full_torque_A);
  if (!start) return under_their_keys(start.problems());
  const auto observer = design::sensorless_observer(motor, spec, s.control.sensorless.follows);
  if (!observer) return under_their_keys(observer.problems());
  control::SensorlessDriveConfig<double> chip = design::sensorless_drive(drive, *start, *observer);
  chip.source.has_hall = s.sensors.rotor == RotorSensing::hall;
  chip.source.falls_back = s.control.sensorless.falls_back;
  chip.source.wanted = s.control.sensorless.commutates == Commutates::hall ? control::RotorSource::hall
                                                                           : control::RotorSource::back_emf;
  SensorlessAround out{{.drive = chip}, start->steps};
  out.steps.insert(out.steps.end(), observer->steps.begin(), observer->steps.end());
  if (s.control.sensorless.starts_by != StartsBy::pulses) return out;
  const auto pulses = design::pulse_start(motor, pulse_spec_of(s, basis, start->start_current_A));
  if (!pulses) return under_their_keys(pulses.problems());
  out.config.pulses = pulses->pulses;
  out.steps.insert(out.steps.end(), pulses->steps.begin(), pulses->steps.end());
  return out;
}

}  // namespace sixstep::study
