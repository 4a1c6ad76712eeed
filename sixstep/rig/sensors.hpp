// SPDX-License-Identifier: Apache-2.0
// What a board's sensors and peripherals make of the plant, and what the firmware's own blocks make of that:
// counts of an ADC, phase currents or one shunt in the DC link, captured times of Hall edges. Every input is
// ideal until its part is switched on.
#pragma once
#include <cmath>

#include "sixstep/base/angle.hpp"
#include "sixstep/control/adc.hpp"
#include "sixstep/control/hall.hpp"
#include "sixstep/control/hall_speed.hpp"
#include "sixstep/control/one_shunt.hpp"
#include "sixstep/rig/adc.hpp"
#include "sixstep/rig/units.hpp"
#include "sixstep/sim/instant.hpp"

namespace sixstep::rig {

enum class CurrentSensing : std::uint8_t { ideal, phases, dc_link };

struct SensorsConfig {
  AdcPath current{};  ///< of each phase, or of the shunt
  AdcPath bus{};
  double least_duty = 1.0;  ///< DC link: a sample counts above this duty (one_shunt.hpp)
  double fade = 1.0;        ///< of a hidden current per period, exp(-R T_s/L)
  double capture_Hz = 1e6;  ///< of the timer that captures the edges
  double timeout_s = 0.05;  ///< no edge for so long is standstill
  std::uint64_t seed = 0;   ///< of the noise
  CurrentSensing currents = CurrentSensing::ideal;
  bool calibrated = true;  ///< offsets were measured, with their noise, before the run
  bool measures_bus = false;
  bool rotor_from_hall = false;  ///< speed and position from captured edges
  bool decodes_hall = false;     ///< follow the lines, to name a broken one
  std::uint8_t commutation_samples = 0;
  std::uint8_t edges = 6;  ///< that a speed is taken over
};

/// One sample instant: the plant in SI and the command in effect.
struct Sample {
  double i_A[3]{};
  double dc_link_A = 0.0;  ///< sum of the legs connected high: what a shunt carries
  double bus_V = 0.0;
  sim::Instant at{};
  std::uint64_t number = 0;
  double duty = 0.0;
  bool reversed = false;
};

template <class Scalar>
class Sensors {
 public:
  Sensors() = default;
  Sensors(const SensorsConfig& config, const Units& units, double pole_pairs, std::int64_t sector,
          std::uint8_t pins);

  /// Whether anything here is not ideal.
  bool on() const { return on_; }
  bool decodes_hall() const { return on_ && (config_.decodes_hall || config_.rotor_from_hall); }
  /// A Hall line changed.
  void hall_edge(std::uint8_t pins, const sim::Instant& at);
  /// The driven pair moved on.
  void commutated() {
    if (config_.currents == CurrentSensing::dc_link) control::one_shunt_commutation(shunt_config_, shunt_);
  }
  /// Puts what was sensed in the place of what is.
  void sense(control::Measurement<Scalar>& measured, const Sample& sample);
  /// 1..3: the line that made an impossible code; 0: none, or it cannot be told.
  std::uint8_t broken_line() const { return broken_line_; }

 private:
  // Which input a random number belongs to; far from the streams of a series' spread.
  static constexpr std::uint64_t stream = std::uint64_t{0x5e5} << 32, calibration = 8;
  static constexpr std::size_t bus_input = 3;

  std::uint32_t count_at(const sim::Instant& t) const {
    return static_cast<std::uint32_t>(
        static_cast<std::uint64_t>(std::floor(t.seconds() * config_.capture_Hz)));
  }
  Scalar read(const AdcPath& path, const control::AdcConfig<Scalar>& adc, std::size_t input, double x,
              std::uint64_t number) const {
    return control::adc_value(adc, adc_[input], converted(path, x, {config_.seed, stream + input, number}));
  }
  control::AdcConfig<Scalar> decoding(const AdcPath& path, double unit) const;
  void calibrate();

  SensorsConfig config_{};
  bool on_ = false;
  control::AdcConfig<Scalar> current_adc_{}, bus_adc_{};
  control::AdcState adc_[4]{};
  control::OneShuntConfig<Scalar> shunt_config_{};
  control::OneShuntState<Scalar> shunt_{};
  control::HallConfig hall_config_{};
  control::HallState hall_{};
  control::HallSpeedConfig<Scalar> speed_config_{};
  control::HallSpeedState speed_{};
  control::HallPositionConfig<Scalar> position_config_{};
  control::HallPositionState position_{};
  std::uint8_t broken_line_ = 0;
};

/// Of a gain whose output is counted in raw units (adc.hpp, hall_speed.hpp): the last bit of a fixed format.
template <class Scalar>
double raw_unit() {
  if constexpr (std::is_arithmetic_v<Scalar>)
    return 1.0;
  else
    return static_cast<double>(Scalar::from_raw(1));
}

template <class Scalar>
Sensors<Scalar>::Sensors(const SensorsConfig& config, const Units& units, double pole_pairs,
                         std::int64_t sector, std::uint8_t pins)
    : config_(config),
      on_(config.currents != CurrentSensing::ideal || config.measures_bus || config.rotor_from_hall ||
          config.decodes_hall) {
  if (!on_) return;
  const double sector_rad = base::pi / 3 / pole_pairs, sector_deg = 60.0 / pole_pairs;
  current_adc_ = decoding(config.current, units.current_A);
  bus_adc_ = decoding(config.bus, units.voltage_V);
  shunt_config_ = {Scalar(config.least_duty), config.commutation_samples, Scalar(config.fade)};
  using Ratio = control::TickRatio<Scalar>;
  speed_config_ = {Ratio(sector_rad * config.capture_Hz / units.speed_rad_s),
                   static_cast<std::uint32_t>(config.timeout_s * config.capture_Hz), config.edges};
  using Gain = control::Gain<Scalar>;
  position_config_ = {Gain(sector_deg / units.position_deg / raw_unit<Scalar>()),
                      Gain(sector_deg / units.position_deg)};
  position_.sectors = static_cast<std::int32_t>(sector);
  control::hall_step(hall_config_, hall_, pins);
  if (config.calibrated) calibrate();
}

template <class Scalar>
control::AdcConfig<Scalar> Sensors<Scalar>::decoding(const AdcPath& path, double unit) const {
  if (!(path.range > 0)) return {};
  return {.per_eighth = control::Gain<Scalar>(path.lsb() / 8 / unit / raw_unit<Scalar>()),
          .offset_counts = path.zero(),
          .offset_tolerance = 0x7fff};
}

/// Before a run the bridge is off and no current flows; the bus has no zero to be found.
template <class Scalar>
void Sensors<Scalar>::calibrate() {
  if (config_.currents == CurrentSensing::ideal) return;
  for (std::size_t input = 0; input < 3; ++input)
    for (std::uint64_t n = 0;; ++n) {
      const base::RandomPlace place{config_.seed, stream + calibration + input, n};
      const std::uint16_t counts = converted(config_.current, 0.0, place);
      if (control::adc_calibrate(current_adc_, adc_[input], counts) != control::Calibration::running) break;
    }
}

template <class Scalar>
void Sensors<Scalar>::hall_edge(std::uint8_t pins, const sim::Instant& at) {
  const std::uint32_t now = count_at(at);
  const bool overdue = control::edge_overdue(speed_config_, speed_, now);
  const control::HallReading reading = control::hall_step(hall_config_, hall_, pins, overdue);
  if (reading.line != 0) broken_line_ = reading.line;
  control::hall_speed_edge(speed_, now, reading.moved);
  control::hall_position_edge(position_, reading.moved);
}

template <class Scalar>
void Sensors<Scalar>::sense(control::Measurement<Scalar>& m, const Sample& s) {
  if (config_.currents == CurrentSensing::phases) {
    m.i_a_A = read(config_.current, current_adc_, 0, s.i_A[0], s.number);
    m.i_b_A = read(config_.current, current_adc_, 1, s.i_A[1], s.number);
    m.i_c_A = read(config_.current, current_adc_, 2, s.i_A[2], s.number);
  } else if (config_.currents == CurrentSensing::dc_link) {
    const Scalar shunt_A = read(config_.current, current_adc_, 0, s.dc_link_A, s.number);
    const Scalar i_m =
        control::one_shunt_step(shunt_config_, shunt_, s.reversed, from_si<Scalar>(s.duty, 1.0), shunt_A);
    control::set_phase_currents(m, control::positive_pair(control::sector_of_hall(m.hall)), i_m);
  }
  if (config_.measures_bus) m.bus_V = read(config_.bus, bus_adc_, bus_input, s.bus_V, s.number);
  if (!config_.rotor_from_hall) return;
  const std::uint32_t now = count_at(s.at);
  m.speed_rad_s = control::hall_speed(speed_config_, speed_, now);
  m.position_deg = control::hall_position(position_config_, position_, speed_.direction,
                                          control::sector_fraction(speed_config_, speed_, now));
}

}  // namespace sixstep::rig
