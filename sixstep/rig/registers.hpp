// SPDX-License-Identifier: Apache-2.0
// Registers of a chip: the counts of its converters and capture timer, computed from the plant.
#pragma once
#include "sixstep/rig/adc.hpp"
#include "sixstep/rig/capture_clock.hpp"
#include "sixstep/rig/low_side_sample.hpp"
#include "sixstep/rig/shaft_ports.hpp"
#include "sixstep/sim/instant.hpp"

namespace sixstep::rig {

enum class CurrentMeasurement : std::uint8_t { ideal, phases, dc_link, low_side };

/// Source of speed and position between Hall edges.
enum class HallAngleFrom : std::uint8_t {
  sectors,        ///< sectors of 60 degrees, counted one by one
  angle,          ///< an angle that is extrapolated from edge to edge
  learned_edges,  ///< like `angle`, with edge positions that the drive learns while the motor turns
};

struct SensorsConfig {
  AdcPath current{};  ///< converter of each phase, or of each shunt
  AdcPath bus{};
  double least_duty = 1.0;  ///< DC link: a sample is valid only above this duty (one_shunt.hpp)
  control::LowSideConfig<double> low_side{};  ///< low-side shunts, and the duties at which they count
  double fade = 1.0;        ///< factor per period on the estimate of an unmeasured current, exp(-R T_s/L)
  double capture_Hz = 1e6;  ///< clock of the timer that captures the edges
  double timeout_s = 0.05;  ///< s; the rotor counts as at rest after this time without an edge
  std::uint64_t seed = 0;   ///< seed of the noise
  CurrentMeasurement currents = CurrentMeasurement::ideal;
  bool calibrated = true;  ///< true: the offsets are measured, with noise, before the run
  bool measures_bus = false;
  bool rotor_from_hall = false;  ///< true: speed and position are computed from captured edges
  bool decodes_hall = false;     ///< true: the lines are decoded, to find a broken line
  std::uint8_t commutation_samples = 0;
  std::uint8_t edges = 6;  ///< number of edges over which a speed is averaged
  HallAngleFrom hall_angle = HallAngleFrom::sectors;
  bool commutates_by_angle = false;  ///< true: the drive commutates at a sample, by the measured angle
  std::uint8_t learned_edges = 1;  ///< number of edges over which a speed is averaged after the positions are
                                   ///< learned
  std::uint16_t calibration_turns = 8;  ///< number of electrical turns in which the edge positions are
                                        ///< learned
  double hall_delay_s = 0.0;            ///< delay of the edges according to the data sheet
  double hall_hysteresis_deg = 0.0;
  double window_s = 0.0;      ///< s; if the time of `edges` edges is longer, a speed is measured over one
                              ///< edge; 0: always over `edges` edges
  ShaftSensorConfig shaft{};  ///< an encoder or a resolver instead of the Hall probes
  double period_s = 0.0;      ///< period of the control ticks

  /// True if all measurements are ideal.
  bool ideal() const {
    return currents == CurrentMeasurement::ideal && !measures_bus && !rotor_from_hall && !decodes_hall &&
           shaft.kind == ShaftSensor::none;
  }
};

/// The window in counts of the timer: 0 if there is no window, else at least 1.
inline std::uint32_t window_ticks(const SensorsConfig& config) {
  if (!(config.window_s > 0.0)) return 0;
  const double ticks = config.window_s * config.capture_Hz;
  return ticks < 1.0 ? 1u : ticks < 0x1p31 ? static_cast<std::uint32_t>(ticks) : 0x80000000u;
}

/// The plant's values at one sample instant, in SI, and the command in effect.
struct Sample {
  double i_A[3]{};
  double dc_link_A = 0.0;  ///< current of the shunt: sum of the currents of the legs connected high
  double bus_V = 0.0;
  sim::Instant at{};
  std::uint64_t number = 0;
  double duty = 0.0;
  bool reversed = false;
  LowSideSample low_side{};
  plant::ShaftAngle<double> shaft{};
};

class Registers {
 public:
  Registers() = default;
  explicit Registers(const SensorsConfig& config)
      : current_(config.current), bus_(config.bus), capture_(config.capture_Hz), seed_(config.seed) {}

  /// Counts of input 0, 1 or 2: of one phase current each, or of the shunt at input 0.
  std::uint16_t current_counts(std::size_t input, double i_A, std::uint64_t sample) const {
    return converted(current_, i_A, {seed_, stream + input, sample});
  }
  std::uint16_t bus_counts(const Sample& s) const {
    return converted(bus_, s.bus_V, {seed_, stream + bus_input, s.number});
  }
  /// Counts of terminal 0, 1 or 2. Divider and converter of a terminal are equal to divider and converter of
  /// the bus.
  std::uint16_t terminal_counts(std::size_t leg, double u_V, std::uint64_t sample) const {
    return converted(bus_, u_V, {seed_, stream + terminals + leg, sample});
  }
  /// Counts of one sample before the run, with the bridge off and without current.
  std::uint16_t calibration_counts(std::size_t input, std::uint64_t sample) const {
    return converted(current_, 0.0, {seed_, stream + calibration + input, sample});
  }
  /// Sets the amplifiers' offset, A, from now on.
  void set_current_offset(double offset_A) { current_.offset = offset_A; }
  void set_current_gain_error(double part) { current_.gain_error = part; }
  /// Present count of the free-running counter.
  std::uint32_t counter(const sim::Instant& t) const { return capture_.counts(t); }

 private:
  // Streams of random numbers per input; they differ from the streams that a series' spread uses.
  static constexpr std::uint64_t stream = std::uint64_t{0x5e5} << 32, calibration = 8, terminals = 16;
  static constexpr std::size_t bus_input = 3;

  AdcPath current_{}, bus_{};
  CaptureClock capture_{1e6};
  std::uint64_t seed_ = 0;
};

}  // namespace sixstep::rig
