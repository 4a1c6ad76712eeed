// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/compile/shaft_sensor.hpp"

#include <algorithm>
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/base/decimal.hpp"
#include "sixstep/base/elementary.hpp"
#include "sixstep/design/loops/resolver_watch.hpp"
#include "sixstep/design/loops/tracking_loop.hpp"

namespace sixstep::study {

namespace {

/// Limits of the resolver's signals. The drive or the converter chip computes these signals from the
/// windings' voltages. The drive's signal is half the difference of two samples, each rounded to a count; a
/// converter chip's signal is one sample.
rig::ResolverWatch watch_of(const rig::ShaftSensorConfig& given) {
  const plant::Resolver r = rig::windings_of(given.resolver);
  const bool sampled = given.resolver.reading == rig::ResolverReading::sampled;
  const double noise = given.resolver.noise_V / r.amplitude_V;
  design::ResolverShows whole{.k_1 = 1.0, .k_2 = 1 + r.imbalance, .quadrature_rad = r.quadrature_rad};
  double count = 0.0;
  whole.noise = noise;
  if (sampled) {
    count = rig::resolver_adc(given).lsb() / r.amplitude_V;
    whole.noise = std::sqrt((noise * noise + count * count / 12) / 2);
    whole.k_1 = base::cos(r.phase_1_rad);
    whole.k_2 *= base::cos(r.phase_2_rad);
    // Calibration compensates the imbalance by a gain, which also amplifies the noise.
    if (given.resolver.calibrated)
      whole = {.noise = whole.noise / std::min(whole.k_1, whole.k_2 * base::cos(r.quadrature_rad))};
  }
  const design::ResolverLimits limits = design::resolver_limits(whole);
  // The first result after a fault still contains a sample from before the fault, so that two results are
  // needed.
  const int results = sampled ? 2 : 1;
  // Normal noise exceeds six standard deviations less often than once in 10^8 samples; rounding adds up to
  // one count.
  return {.least_square = limits.least_square,
          .greatest_square = limits.greatest_square,
          .silent = 6 * whole.noise + count,
          .in_a_row = std::max(limits.in_a_row, results)};
}

/// Designs the loop that tracks the resolver, in the drive or in the converter chip, and the monitoring of
/// its signals.
void take_resolver(const Scenario& s, rig::ShaftSensorConfig& to) {
  const Resolver& r = s.sensors.resolver;
  to.samples_per_peak = samples_per_peak(s);
  to.watch = watch_of(to);
  // check() limits the bandwidth to half the rate of the loop's steps.
  if (const auto loop = design::tracking_loop({.bandwidth_rad_s = 2 * base::pi * r.bandwidth_Hz,
                                               .damping = r.damping,
                                               .period_s = tracking_period_s(s)}))
    to.tracking = design::tracking_config(*loop);
}

/// For a linear motor, one period of the magnets counts as a turn.
void take_encoder(const Scenario& s, rig::ShaftSensorConfig& to) {
  if (!s.sensors.encoder.pitch_mm || !s.sheet.pole_pitch_mm) return;
  to.linear = true;
  // check() allows up to a million lines, but a design can call this before check().
  to.encoder.lines = static_cast<int>(std::clamp(std::floor(lines_to_period(s) + 0.5), 0.0, 0x7fffffffp0));
  to.gear = base::times_ten_to(s.sheet.pole_pitch_mm->value, -3) / base::pi;
}

rig::ShaftSensor kind_of(RotorSensing rotor) {
  switch (rotor) {
    case RotorSensing::ideal:
    case RotorSensing::hall:
      break;
    case RotorSensing::encoder:
      return rig::ShaftSensor::encoder;
    case RotorSensing::absolute:
      return rig::ShaftSensor::absolute;
    case RotorSensing::resolver:
      return rig::ShaftSensor::resolver;
  }
  return rig::ShaftSensor::none;
}

}  // namespace

int samples_per_peak(const Scenario& s) {
  const double periods = 0.5 / (s.sensors.resolver.excitation_Hz * s.pwm.period_s);
  return static_cast<int>(std::clamp(std::floor(periods + 0.5), 1.0, 1e6));
}

double lines_to_period(const Scenario& s) {
  return 2 * s.sheet.pole_pitch_mm->value / *s.sensors.encoder.pitch_mm;
}

double tracking_period_s(const Scenario& s) {
  return s.sensors.resolver.reading == rig::ResolverReading::tracking ? 1.0 / s.sensors.resolver.converter_Hz
                                                                      : samples_per_peak(s) * s.pwm.period_s;
}

void take_hall_angle(const Scenario& s, rig::SensorsConfig& to) {
  const Sensors& from = s.sensors;
  to.hall_angle = from.hall_angle;
  to.commutates_by_angle = s.pwm.commutation == CommutationAt::sample;
  to.learned_edges = static_cast<std::uint8_t>(std::max(from.speed_edges, 1));
  to.calibration_turns = static_cast<std::uint16_t>(from.hall_calibration_turns);
  to.hall_delay_s = from.hall_delay_s;
  to.hall_hysteresis_deg = from.hall_hysteresis_deg;
}

double mounting_offset_deg(const Sensors& x) {
  switch (x.rotor) {
    case RotorSensing::ideal:
    case RotorSensing::hall:
      break;
    case RotorSensing::encoder:
      return x.encoder.offset_deg;
    case RotorSensing::absolute:
      return x.absolute.offset_deg;
    case RotorSensing::resolver:
      return x.resolver.offset_deg;
  }
  return 0.0;
}

rig::ShaftSensorConfig shaft_sensor_config(const Scenario& s) {
  const Sensors& x = s.sensors;
  rig::ShaftSensorConfig to{.kind = kind_of(x.rotor), .watched = x.watched};
  to.encoder = x.encoder;
  to.absolute = x.absolute;
  to.resolver = x.resolver;
  if (to.kind == rig::ShaftSensor::encoder) take_encoder(s, to);
  if (to.kind == rig::ShaftSensor::resolver) take_resolver(s, to);
  to.on_load = x.shaft == SensorShaft::load;
  if (to.on_load) to.gear = s.load.gear;
  to.offset_deg = mounting_offset_deg(s.sensors);
  to.believed_offset_deg = s.believed.sensor_offset_deg;
  to.believed_pole_pairs = s.believed.pole_pairs.value_or(0);
  return to;
}

}  // namespace sixstep::study
