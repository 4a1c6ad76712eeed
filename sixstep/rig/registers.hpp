// SPDX-License-Identifier: Apache-2.0
// Registers are the counts that a firmware finds in its chip: converters and capture timer make them of the
// plant.
#pragma once
#include "sixstep/rig/adc.hpp"
#include "sixstep/rig/capture_clock.hpp"
#include "sixstep/rig/shaft_ports.hpp"
#include "sixstep/sim/instant.hpp"

namespace sixstep::rig {

enum class CurrentMeasurement : std::uint8_t { ideal, phases, dc_link };

/// Where speed and position between Hall edges come from.
enum class HallAngleFrom : std::uint8_t {
  sectors,        ///< sectors of 60 degrees, passed one by one
  angle,          ///< an angle that runs on from edge to edge
  learned_edges,  ///< the same, by edges whose places were learned as the rotor turned
};

struct SensorsConfig {
  AdcPath current{};  ///< of each phase, or of the shunt
  AdcPath bus{};
  double least_duty = 1.0;  ///< DC link: a sample counts above this duty (one_shunt.hpp)
  double fade = 1.0;        ///< of a hidden current per period, exp(-R T_s/L)
  double capture_Hz = 1e6;  ///< of the timer that captures the edges
  double timeout_s = 0.05;  ///< no edge for so long is standstill
  std::uint64_t seed = 0;   ///< of the noise
  CurrentMeasurement currents = CurrentMeasurement::ideal;
  bool calibrated = true;  ///< offsets were measured, with their noise, before the run
  bool measures_bus = false;
  bool rotor_from_hall = false;  ///< speed and position from captured edges
  bool decodes_hall = false;     ///< follow the lines, to name a broken one
  std::uint8_t commutation_samples = 0;
  std::uint8_t edges = 6;  ///< that a speed is taken over
  HallAngleFrom hall_angle = HallAngleFrom::sectors;
  bool commutates_by_angle = false;     ///< at a sample, by the angle seen
  std::uint8_t learned_edges = 1;       ///< that a speed is taken over once their places are known
  std::uint16_t calibration_turns = 8;  ///< electrical ones that edges are learned from
  double hall_delay_s = 0.0;            ///< by which edges are seen late, as the data sheet says
  double hall_hysteresis_deg = 0.0;
  double window_s = 0.0;      ///< one edge where these take longer; 0: always `edges`
  ShaftSensorConfig shaft{};  ///< an encoder or a resolver in the place of the Hall probes
  double period_s = 0.0;      ///< of the control ticks

  /// The controller is told what is.
  bool ideal() const {
    return currents == CurrentMeasurement::ideal && !measures_bus && !rotor_from_hall && !decodes_hall &&
           shaft.kind == ShaftSensor::none;
  }
};

/// The window in counts of the timer: at least one where there is one.
inline std::uint32_t window_ticks(const SensorsConfig& config) {
  if (!(config.window_s > 0.0)) return 0;
  const double ticks = config.window_s * config.capture_Hz;
  return ticks < 1.0 ? 1u : ticks < 0x1p31 ? static_cast<std::uint32_t>(ticks) : 0x80000000u;
}

/// One sample instant: the plant in SI and the command in effect.
struct Sample {
  double i_A[3]{};
  double dc_link_A = 0.0;  ///< sum of the legs connected high: what a shunt carries
  double bus_V = 0.0;
  sim::Instant at{};
  std::uint64_t number = 0;
  double duty = 0.0;
  bool reversed = false;
  plant::ShaftAngle<double> shaft{};
};

class Registers {
 public:
  Registers() = default;
  explicit Registers(const SensorsConfig& config)
      : current_(config.current), bus_(config.bus), capture_(config.capture_Hz), seed_(config.seed) {}

  /// Of input 0 to 2: a phase current each, or the shunt as input 0.
  std::uint16_t current_counts(std::size_t input, double i_A, std::uint64_t sample) const {
    return converted(current_, i_A, {seed_, stream + input, sample});
  }
  std::uint16_t bus_counts(const Sample& s) const {
    return converted(bus_, s.bus_V, {seed_, stream + bus_input, s.number});
  }
  /// Of terminal 0 to 2, behind the bus's divider and converter.
  std::uint16_t terminal_counts(std::size_t leg, double u_V, std::uint64_t sample) const {
    return converted(bus_, u_V, {seed_, stream + terminals + leg, sample});
  }
  /// A sample before the run, with the bridge off and no current.
  std::uint16_t calibration_counts(std::size_t input, std::uint64_t sample) const {
    return converted(current_, 0.0, {seed_, stream + calibration + input, sample});
  }
  /// In the unit of the current, from now on.
  void set_current_offset(double offset_A) { current_.offset = offset_A; }
  void set_current_gain_error(double part) { current_.gain_error = part; }
  /// The free-running counter.
  std::uint32_t counter(const sim::Instant& t) const { return capture_.counts(t); }

 private:
  // Which input a random number belongs to; far from the streams of a series' spread.
  static constexpr std::uint64_t stream = std::uint64_t{0x5e5} << 32, calibration = 8, terminals = 16;
  static constexpr std::size_t bus_input = 3;

  AdcPath current_{}, bus_{};
  CaptureClock capture_{1e6};
  std::uint64_t seed_ = 0;
};

}  // namespace sixstep::rig
