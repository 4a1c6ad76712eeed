// SPDX-License-Identifier: Apache-2.0
// Decodes an encoder or a resolver with the blocks of control/sensing/. The results are speed, position, and
// the Hall code of the measured sector. A sensor on the motor's shaft determines the commutation. With a
// sensor on the load's side, the Hall probes determine the commutation. Speed and position of the load are
// then multiplied by the gear ratio, which converts them to the motor's shaft.
//
// If `watched` is true, the decoder detects two states that are impossible with an intact sensor:
// - a resolver's sum of squares is outside its limits,
// - at an encoder's index the count has an error of more than a sector, so that the wrong pair was driven.
#pragma once
#include "sixstep/base/angle.hpp"
#include "sixstep/control/commutation.hpp"
#include "sixstep/control/drive.hpp"
#include "sixstep/control/sensing/gray.hpp"
#include "sixstep/control/sensing/pulse_speed.hpp"
#include "sixstep/control/sensing/quadrature.hpp"
#include "sixstep/control/sensing/resolver.hpp"
#include "sixstep/rig/bases.hpp"
#include "sixstep/rig/raw_unit.hpp"
#include "sixstep/rig/registers.hpp"

namespace sixstep::rig {

template <class Scalar>
class RotorDecoder {
 public:
  RotorDecoder(const SensorsConfig& config, const Bases& bases, const plant::ShaftAngle<double>& at);

  /// Replaces the values in `m` that the sensor measures. `now` is the count of the timer that captures
  /// edges.
  void sense(control::Measurement<Scalar>& m, const Sample& s, ShaftPorts& ports, std::uint32_t now);
  /// Fault of the sensor according to the last samples.
  const ShaftFinding& found() const { return found_; }
  /// Angle at the last sample; 0 before the first sample, and for a sensor on the load's shaft.
  control::BinaryAngle electrical_angle() const { return electrical_; }

 private:
  void of_encoder(control::Measurement<Scalar>& m, ShaftPorts& ports, std::uint32_t now);
  void of_absolute(control::Measurement<Scalar>& m, const ShaftPorts& ports);
  void of_resolver(control::Measurement<Scalar>& m, const Sample& s, ShaftPorts& ports);
  void of_converter(control::Measurement<Scalar>& m, const TrackingConverter& converter);
  /// Sets the position from a number of turns and the angle within the turn, in units of 2^-16 turn.
  void place(control::Measurement<Scalar>& m, const control::UnwrappedAngle& at);
  void commutate_at(control::Measurement<Scalar>& m, control::BinaryAngle electrical) {
    if (on_load_) return;
    electrical_ = electrical;
    m.hall = control::hall_of_sector(control::sector_of_angle(electrical));
  }
  control::BinaryAngle electrical_of(control::BinaryAngle mechanical, std::uint8_t pole_pairs) const {
    return control::electrical_angle(mechanical, pole_pairs, offset_);
  }
  void set_speeds(const SensorsConfig& config, const Bases& bases);
  void set_resolver(const SensorsConfig& config, const Bases& bases, const control::UnwrappedAngle& at);
  void set_watch(const ShaftSensorConfig& given);
  void look_at_index(const ShaftSensorConfig& given);
  void look_at_windings(const ShaftSensorConfig& given, const control::ResolverCounts& before,
                        bool positive_peak);

  std::uint8_t pole_pairs_ = 1;
  bool on_load_ = false;
  control::BinaryAngle offset_ = 0;  ///< the assumed mounting offset with opposite sign, to be added
  control::Gain<Scalar> deg_per_unit_{};
  control::QuadratureConfig quadrature_{};
  control::QuadratureState quarters_{};
  control::PulseSpeedConfig<Scalar> pulse_config_{};
  control::PulseSpeedState pulses_{};
  std::int64_t counted_ = 0;
  control::GrayConfig<Scalar> gray_config_{};
  control::GrayState gray_{};
  control::ResolverConfig<Scalar> resolver_config_{};
  control::ResolverState resolver_{};
  control::Gain<Scalar> resolver_speed_{};
  control::UnwrappedAngle seen_{};
  control::BinaryAngle electrical_ = 0;
  std::int32_t per_peak_ = 0;  ///< change of the resolver's angle per peak, in units of 2^-32 turn
  std::uint8_t per_turn_ = 1, bits_ = 32;
  std::int64_t samples_per_peak_ = 1, period_ticks_ = 1;
  std::int64_t first_ticks_ = -1, last_peak_ = -1;  ///< time of the first sample, ps, and time of the last
                                                    ///< peak relative to it; -1: none so far
  bool positive_peak_ = true;
  ShaftFinding found_{};
};

namespace detail {

/// Number of sensor turns, and the angle within the sensor's turn. One turn of the shaft is `times` sensor
/// turns.
inline control::UnwrappedAngle unwrapped(const plant::ShaftAngle<double>& at, std::int64_t times) {
  const std::int64_t fine = plant::parts_of_turn(at, std::int64_t{1} << 32);
  const std::int64_t all = fine * times;
  return {static_cast<control::BinaryAngle>(static_cast<std::uint64_t>(all)),
          static_cast<std::int32_t>(all >> 32)};
}

}  // namespace detail

template <class Scalar>
RotorDecoder<Scalar>::RotorDecoder(const SensorsConfig& config, const Bases& bases,
                                   const plant::ShaftAngle<double>& at)
    : pole_pairs_(static_cast<std::uint8_t>(
          config.shaft.believed_pole_pairs > 0 ? config.shaft.believed_pole_pairs : at.pole_pairs)),
      on_load_(config.shaft.on_load),
      offset_(control::BinaryAngle{0} - control::binary_degrees(config.shaft.believed_offset_deg)) {
  const ShaftSensorConfig& given = config.shaft;
  per_turn_ = given.kind == ShaftSensor::resolver ? static_cast<std::uint8_t>(given.resolver.pole_pairs)
                                                  : std::uint8_t{1};
  deg_per_unit_ =
      control::Gain<Scalar>(360.0 / 65536 / per_turn_ * given.gear / bases.position_deg / raw_unit<Scalar>());
  seen_ = detail::unwrapped(mounted(given.offset_deg, at), per_turn_);
  set_speeds(config, bases);
  if (given.kind == ShaftSensor::encoder) {
    quadrature_ = control::quadrature_of_lines(static_cast<std::uint32_t>(given.encoder.lines));
    counted_ = encoder_quarter(given, at);
    quarters_.referenced = given.encoder.referenced;
    if (given.encoder.referenced) {
      const std::int64_t turn = given.quarters();
      quarters_.in_turn = static_cast<std::uint32_t>((counted_ % turn + turn) % turn);
      quarters_.turns = seen_.turns;
    }
  }
  if (given.kind == ShaftSensor::absolute) gray_.position.turns = seen_.turns;
  if (given.kind == ShaftSensor::resolver) set_resolver(config, bases, seen_);
}

template <class Scalar>
void RotorDecoder<Scalar>::set_speeds(const SensorsConfig& config, const Bases& bases) {
  const ShaftSensorConfig& given = config.shaft;
  const double turn_rad = 2 * base::pi * given.gear, unit_rad = turn_rad / 0x1p32;
  if (given.kind == ShaftSensor::encoder)
    pulse_config_ = {control::TickRatio<Scalar>(turn_rad / static_cast<double>(given.quarters()) *
                                                config.capture_Hz / bases.speed_rad_s),
                     static_cast<std::uint32_t>(config.timeout_s * config.capture_Hz)};
  if (given.kind == ShaftSensor::absolute) {
    gray_config_.bits = static_cast<std::uint8_t>(given.absolute.bits);
    gray_config_.span = static_cast<std::uint8_t>(given.absolute.speed_samples);
    gray_config_.speed_per_unit = control::Gain<Scalar>(
        unit_rad / (given.absolute.speed_samples * config.period_s) / bases.speed_rad_s / raw_unit<Scalar>());
  }
  if (given.kind != ShaftSensor::resolver) return;
  const double step_s = given.resolver.reading == ResolverReading::tracking
                            ? 1.0 / given.resolver.converter_Hz
                            : given.samples_per_peak * config.period_s;
  resolver_speed_ =
      control::Gain<Scalar>(unit_rad / step_s / per_turn_ / bases.speed_rad_s / raw_unit<Scalar>());
}

/// The decoder's number for a resolver signal of the expected amplitude. It is below 1 to allow larger
/// signals.
inline constexpr double full_signal = 0.6;

/// Sets the decoder's configuration, and its tracking loop to the shaft's initial angle.
template <class Scalar>
void RotorDecoder<Scalar>::set_resolver(const SensorsConfig& config, const Bases&,
                                        const control::UnwrappedAngle& at) {
  const ShaftSensorConfig& given = config.shaft;
  const double per_count = full_signal * resolver_adc(given).lsb() / (2 * given.resolver.amplitude_V);
  resolver_config_.cos_per_count = resolver_config_.sin_per_count =
      control::Gain<Scalar>(per_count / raw_unit<Scalar>());
  if (given.resolver.calibrated) {
    const plant::Resolver r = windings_of(given.resolver);
    // At a peak of the excitation, the signal of a winding with the phase d is cos d times its amplitude.
    const double cos_part = base::cos(r.phase_1_rad), sin_part = (1 + r.imbalance) * base::cos(r.phase_2_rad);
    const double g_c = per_count / cos_part, g_s = per_count / (sin_part * base::cos(r.quadrature_rad));
    resolver_config_.cos_per_count = control::Gain<Scalar>(g_c / raw_unit<Scalar>());
    resolver_config_.sin_per_count = control::Gain<Scalar>(g_s / raw_unit<Scalar>());
    resolver_config_.skew = control::Gain<Scalar>(base::sin(r.quadrature_rad) / base::cos(r.quadrature_rad));
  }
  if (given.watched) set_watch(given);
  resolver_config_.loop = given.tracking;
  resolver_.loop.angle = at.angle;
  bits_ = static_cast<std::uint8_t>(given.resolver.bits);
  samples_per_peak_ = given.samples_per_peak;
  period_ticks_ = sim::to_instant(config.period_s).ticks;
}

/// Sets the limits of the sum of squares. An upper limit that the number format cannot represent is not
/// checked.
template <class Scalar>
void RotorDecoder<Scalar>::set_watch(const ShaftSensorConfig& given) {
  constexpr double unit = full_signal * full_signal;
  resolver_config_.least_square = Scalar(unit * given.watch.least_square);
  if (unit * given.watch.greatest_square < 1.0)
    resolver_config_.greatest_square = Scalar(unit * given.watch.greatest_square);
  resolver_config_.lost_after = static_cast<std::uint8_t>(given.watch.in_a_row);
}

template <class Scalar>
void RotorDecoder<Scalar>::sense(control::Measurement<Scalar>& m, const Sample& s, ShaftPorts& ports,
                                 std::uint32_t now) {
  switch (ports.given().kind) {
    case ShaftSensor::none:
      return;
    case ShaftSensor::encoder:
      return of_encoder(m, ports, now);
    case ShaftSensor::absolute:
      return of_absolute(m, ports);
    case ShaftSensor::resolver:
      return ports.given().resolver.reading == ResolverReading::tracking ? of_converter(m, ports.converter())
                                                                         : of_resolver(m, s, ports);
  }
}

template <class Scalar>
void RotorDecoder<Scalar>::place(control::Measurement<Scalar>& m, const control::UnwrappedAngle& at) {
  const auto units = static_cast<std::int32_t>(static_cast<std::uint32_t>(at.turns) << 16 | at.angle >> 16);
  m.position_deg = control::AngleTraits<Scalar>::scaled(units, deg_per_unit_);
}

/// Before the first index, the Hall probes determine the sector. Each later index corrects counts that the
/// timer missed.
template <class Scalar>
void RotorDecoder<Scalar>::of_encoder(control::Measurement<Scalar>& m, ShaftPorts& ports, std::uint32_t now) {
  const auto moved = static_cast<std::int32_t>(ports.quarters() - counted_);
  counted_ = ports.quarters();
  if (moved != 0) {
    control::quadrature_moved(quadrature_, quarters_, moved);
    control::pulse_edge(pulses_, moved, static_cast<std::int8_t>(ports.edge_direction()), ports.edge_time());
  }
  if (ports.index_passed()) {
    const std::int64_t turn = quadrature_.counts;
    const std::int64_t in_turn = (ports.since_index() % turn + turn) % turn;
    control::quadrature_index(quadrature_, quarters_, static_cast<std::uint32_t>(in_turn));
    look_at_index(ports.given());
  }
  m.speed_rad_s = control::pulse_speed(pulse_config_, pulses_, now);
  const control::BinaryAngle angle = control::quadrature_angle(quadrature_, quarters_);
  place(m, {angle, quarters_.turns});
  if (quarters_.referenced) commutate_at(m, electrical_of(angle, pole_pairs_));
}

template <class Scalar>
void RotorDecoder<Scalar>::look_at_index(const ShaftSensorConfig& given) {
  const double turns = given.on_load ? given.gear : 1.0;
  const double sectors = 6.0 * pole_pairs_ * turns * quarters_.missed / quadrature_.counts;
  if (given.watched && std::fabs(sectors) > 1)
    found_ = {.loss = ShaftLoss::index, .counts = quarters_.missed};
}

template <class Scalar>
void RotorDecoder<Scalar>::of_absolute(control::Measurement<Scalar>& m, const ShaftPorts& ports) {
  const control::GrayReading<Scalar> reading = control::gray_step(gray_config_, gray_, ports.code());
  m.speed_rad_s = reading.speed;
  place(m, reading.position);
  commutate_at(m, electrical_of(reading.position.angle, pole_pairs_));
}

/// Reads a tracking converter, which follows the windings continuously.
template <class Scalar>
void RotorDecoder<Scalar>::of_converter(control::Measurement<Scalar>& m, const TrackingConverter& converter) {
  found_ = converter.found();
  control::unwrap(seen_, converter.angle());
  m.speed_rad_s = control::AngleTraits<Scalar>::scaled(converter.speed(), resolver_speed_);
  place(m, seen_);
  commutate_at(m, electrical_of(seen_.angle, static_cast<std::uint8_t>(pole_pairs_ / per_turn_)));
}

/// Determines which winding has failed, from the samples of the last two peaks.
template <class Scalar>
void RotorDecoder<Scalar>::look_at_windings(const ShaftSensorConfig& given,
                                            const control::ResolverCounts& before, bool positive_peak) {
  const control::ResolverSignals<Scalar> x =
      control::resolver_signals(resolver_config_, before, resolver_.last, positive_peak);
  found_ =
      given.watch.finding(static_cast<double>(x.c) / full_signal, static_cast<double>(x.s) / full_signal);
}

/// Two peaks determine the angle in the middle between them. At the second peak the angle is half a step
/// further. Between peaks the angle is extrapolated with the speed. A call between two samples, for a
/// setpoint that acts at once, is not a peak.
template <class Scalar>
void RotorDecoder<Scalar>::of_resolver(control::Measurement<Scalar>& m, const Sample& s, ShaftPorts& ports) {
  if (first_ticks_ < 0) first_ticks_ = s.at.ticks;
  const std::int64_t passed = s.at.ticks - first_ticks_;
  if (passed % (samples_per_peak_ * period_ticks_) == 0 && passed != last_peak_) {
    last_peak_ = passed;
    const control::ResolverCounts counts = ports.resolver_counts(s.shaft, s.at, s.number),
                                  before = resolver_.last;
    const control::ResolverReading<Scalar> reading =
        control::resolver_step(resolver_config_, resolver_, counts, positive_peak_);
    if (reading.lost) look_at_windings(ports.given(), before, positive_peak_);
    positive_peak_ = !positive_peak_;
    per_peak_ = reading.speed;
    control::unwrap(seen_, resolver_.loop.angle);
  }
  // loop.angle is the prediction for the middle of the next step, a whole step after the middle that was
  // measured.
  const std::int64_t since = passed / period_ticks_ % samples_per_peak_;
  const std::int32_t on = per_peak_ / static_cast<std::int32_t>(samples_per_peak_);
  control::UnwrappedAngle at = seen_;
  control::unwrap(at, seen_.angle + static_cast<control::BinaryAngle>(on * static_cast<std::int32_t>(since) -
                                                                      per_peak_ / 2));
  at.angle = control::quantised(at.angle, bits_);
  m.speed_rad_s = control::AngleTraits<Scalar>::scaled(per_peak_, resolver_speed_);
  place(m, at);
  commutate_at(m, electrical_of(at.angle, static_cast<std::uint8_t>(pole_pairs_ / per_turn_)));
}

}  // namespace sixstep::rig
