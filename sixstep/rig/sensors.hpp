// SPDX-License-Identifier: Apache-2.0
// Measures with the controller's own blocks: phase currents, one shunt in the DC link or low-side shunts,
// the bus, and speed and position from captured Hall edges, an encoder or a resolver. Every input is ideal
// unless the scenario switches its sensor on.
#pragma once
#include "sixstep/base/angle.hpp"
#include "sixstep/control/adc.hpp"
#include "sixstep/control/hall.hpp"
#include "sixstep/control/hall_speed.hpp"
#include "sixstep/control/one_shunt.hpp"
#include "sixstep/rig/board_config.hpp"
#include "sixstep/rig/hall_interpolator.hpp"
#include "sixstep/rig/registers.hpp"
#include "sixstep/rig/rotor_decoder.hpp"

namespace sixstep::rig {

template <class Scalar>
class Sensors {
 public:
  Sensors(const SensorsConfig& config, const Bases& bases, const PowerUp& power_up);

  /// Call it when a Hall line has changed.
  void hall_edge(std::uint8_t pins, const sim::Instant& at);
  /// Call it when the driven pair has changed.
  void commutated() {
    if (config_.currents == CurrentMeasurement::dc_link)
      control::one_shunt_commutation(shunt_config_, shunt_);
  }
  /// Replaces the ideal values in `measured` by the values that the board's sensors measure.
  void sense(control::Measurement<Scalar>& measured, const Sample& sample);
  Registers& registers() { return registers_; }
  ShaftPorts& shaft_ports() { return ports_; }
  const ShaftPorts& shaft_ports() const { return ports_; }
  const HallInterpolator<Scalar>& interpolator() const { return interpolator_; }
  bool follows_shaft() const { return config_.shaft.kind != ShaftSensor::none; }
  /// True if the angle between two Hall edges is available, from a shaft sensor or by extrapolation.
  bool tells_angle() const { return follows_shaft() || interpolates(); }
  /// Angle at the last sample.
  control::BinaryAngle electrical_angle() const {
    return follows_shaft() ? rotor_.electrical_angle() : interpolator_.electrical_angle();
  }
  template <class Real>
  void follow(const ShaftMotion<Real>& motion) {
    ports_.follow(motion);
  }
  /// Fault of an encoder or a resolver.
  const ShaftFinding& shaft_found() const { return rotor_.found(); }
  const control::LowSideState<Scalar>& low_side() const { return low_side_; }
  /// 1..3: the line that caused an invalid code; 0: none, or the line cannot be determined.
  std::uint8_t broken_line() const { return broken_line_; }

 private:
  static constexpr std::size_t bus_input = 3;

  bool interpolates() const {
    return config_.rotor_from_hall && config_.hall_angle != HallAngleFrom::sectors;
  }
  bool decodes_hall() const { return config_.decodes_hall || config_.rotor_from_hall; }
  [[gnu::noinline]] void sense_below(control::Measurement<Scalar>& measured, const Sample& sample);
  Scalar current(std::size_t input, double i_A, const Sample& s) const {
    return control::adc_value(current_adc_, adc_[input], registers_.current_counts(input, i_A, s.number));
  }
  control::AdcConfig<Scalar> decoding(const AdcPath& path, double unit) const;
  void calibrate();

  SensorsConfig config_;
  Registers registers_;
  ShaftPorts ports_;
  RotorDecoder<Scalar> rotor_;
  HallInterpolator<Scalar> interpolator_;
  control::AdcConfig<Scalar> current_adc_{}, bus_adc_{};
  control::AdcState adc_[4]{};
  control::OneShuntConfig<Scalar> shunt_config_{};
  control::OneShuntState<Scalar> shunt_{};
  control::LowSideState<Scalar> low_side_{};
  control::HallConfig hall_config_{};
  control::HallState hall_{};
  control::HallSpeedConfig<Scalar> speed_config_{};
  control::HallSpeedState speed_{};
  control::HallPositionConfig<Scalar> position_config_{};
  control::HallPositionState position_{};
  std::uint8_t broken_line_ = 0;
};

template <class Scalar>
Sensors<Scalar>::Sensors(const SensorsConfig& config, const Bases& bases, const PowerUp& power_up)
    : config_(config),
      registers_(config),
      ports_(config.shaft, config.capture_Hz, config.seed, power_up.shaft),
      rotor_(config, bases, power_up.shaft),
      interpolator_(config, bases, power_up) {
  const double sector_rad = base::pi / 3 / power_up.pole_pairs, sector_deg = 60.0 / power_up.pole_pairs;
  current_adc_ = decoding(config.current, bases.current_A);
  bus_adc_ = decoding(config.bus, bases.voltage_V);
  shunt_config_ = {Scalar(config.least_duty), config.commutation_samples, Scalar(config.fade)};
  using Ratio = control::TickRatio<Scalar>;
  speed_config_ = {Ratio(sector_rad * config.capture_Hz / bases.speed_rad_s),
                   static_cast<std::uint32_t>(config.timeout_s * config.capture_Hz), config.edges,
                   window_ticks(config)};
  using Gain = control::Gain<Scalar>;
  position_config_ = {Gain(sector_deg / bases.position_deg / raw_unit<Scalar>()),
                      Gain(sector_deg / bases.position_deg)};
  position_.sectors = static_cast<std::int32_t>(power_up.sector);
  control::hall_step(hall_config_, hall_, power_up.pins);
  if (config.calibrated) calibrate();
}

template <class Scalar>
control::AdcConfig<Scalar> Sensors<Scalar>::decoding(const AdcPath& path, double unit) const {
  if (!(path.range > 0)) return {};
  return {.per_eighth = control::Gain<Scalar>(path.lsb() / 8 / unit / raw_unit<Scalar>()),
          .offset_counts = path.zero(),
          .offset_tolerance = 0x7fff};
}

/// Measures the current inputs' offsets before a run, with the bridge off and without current. The bus needs
/// no offset calibration.
template <class Scalar>
void Sensors<Scalar>::calibrate() {
  if (config_.currents == CurrentMeasurement::ideal) return;
  for (std::size_t input = 0; input < 3; ++input)
    for (std::uint64_t n = 0;; ++n) {
      const std::uint16_t counts = registers_.calibration_counts(input, n);
      if (control::adc_calibrate(current_adc_, adc_[input], counts) != control::Calibration::running) break;
    }
}

template <class Scalar>
void Sensors<Scalar>::hall_edge(std::uint8_t pins, const sim::Instant& at) {
  if (!decodes_hall()) return;
  const std::uint32_t now = registers_.counter(at);
  const control::HallReading reading = control::hall_step(
      hall_config_, hall_, pins, control::sector_time(speed_, speed_config_.grain_ticks, now));
  if (reading.line != 0) broken_line_ = reading.line;
  if (interpolates()) interpolator_.edge(reading, now);
  control::hall_speed_edge(speed_, now, reading.moved);
  control::hall_position_edge(position_, reading.moved);
}

template <class Scalar>
void Sensors<Scalar>::sense(control::Measurement<Scalar>& m, const Sample& s) {
  // The rotor is measured first, because the shunt's sample belongs to the pair of the measured sector.
  if (follows_shaft()) rotor_.sense(m, s, ports_, registers_.counter(s.at));
  if (interpolates()) interpolator_.measure(m, registers_.counter(s.at));
  if (config_.currents == CurrentMeasurement::phases) {
    m.i_a_A = current(0, s.i_A[0], s);
    m.i_b_A = current(1, s.i_A[1], s);
    m.i_c_A = current(2, s.i_A[2], s);
  } else if (config_.currents == CurrentMeasurement::dc_link) {
    const Scalar shunt_A = current(0, s.dc_link_A, s);
    const Scalar i_m =
        control::one_shunt_step(shunt_config_, shunt_, s.reversed, from_si<Scalar>(s.duty, 1.0), shunt_A);
    control::set_phase_currents(m, control::positive_pair(control::sector_of_hall(m.hall)), i_m);
  } else if (config_.currents == CurrentMeasurement::low_side) {
    sense_below(m, s);
  }
  if (config_.measures_bus) m.bus_V = control::adc_value(bus_adc_, adc_[bus_input], registers_.bus_counts(s));
  if (!config_.rotor_from_hall || interpolates()) return;
  const std::uint32_t now = registers_.counter(s.at);
  m.speed_rad_s = control::hall_speed(speed_config_, speed_, now);
  m.position_deg = control::hall_position(position_config_, position_, speed_.direction,
                                          control::sector_fraction(speed_config_, speed_, now));
}

/// While the bridge is off, the drive takes the currents as 0.
template <class Scalar>
void Sensors<Scalar>::sense_below(control::Measurement<Scalar>& m, const Sample& s) {
  const LowSideSample& by = s.low_side;
  m.i_a_A = m.i_b_A = m.i_c_A = Scalar{};
  if (!by.on) return;
  const Scalar sample_A[3] = {current(0, s.i_A[0], s), current(1, s.i_A[1], s), current(2, s.i_A[2], s)};
  if (by.by_pair) {
    const Scalar i_m = control::low_side_pair(low_side_, by.shown, by.pair, s.reversed, sample_A);
    control::set_phase_currents(m, control::positive_pair(control::sector_of_hall(m.hall)), i_m);
    return;
  }
  control::low_side_legs(low_side_, by.shown, sample_A);
  m.i_a_A = low_side_.leg_A[0];
  m.i_b_A = low_side_.leg_A[1];
  m.i_c_A = low_side_.leg_A[2];
}

}  // namespace sixstep::rig
