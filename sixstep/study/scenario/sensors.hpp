// SPDX-License-Identifier: Apache-2.0
// The board's measurements in a scenario. By default all are ideal. sensors_description.hpp describes each
// key.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "sixstep/control/hall.hpp"
#include "sixstep/rig/front_end_config.hpp"
#include "sixstep/rig/sensors.hpp"
#include "sixstep/rig/wiring.hpp"

namespace sixstep::study {

enum class BusSensing : std::uint8_t { ideal, adc };
enum class RotorSensing : std::uint8_t { ideal, hall, encoder, absolute, resolver };
enum class Level01 : std::uint8_t { low, high };

/// The shaft on which an encoder or a resolver is mounted.
enum class SensorShaft : std::uint8_t { motor, load };

/// Hall lines whose pins show their probe inverted, as bits of a Hall code.
enum class HallLines : std::uint8_t {
  none = 0,
  line_1 = 4,
  line_2 = 2,
  line_3 = 1,
  lines_12 = 6,
  lines_13 = 5,
  lines_23 = 3,
  all = 7
};

/// Legs with a shunt below their lower switch, as bits.
enum class ShuntLegs : std::uint8_t { a = 1, b = 2, ab = 3, c = 4, ac = 5, bc = 6, abc = 7 };

/// A Hall line that breaks.
struct HallBreak {
  std::optional<double> at_s;
  int line = 1;
  Level01 level = Level01::low;
};

// Sensors on the shaft that replace Hall probes. Their structs belong to the board (rig). Only the sensor
// that `rotor` names is used.
using rig::AbsoluteEncoder;
using rig::Encoder;
using rig::Resolver;

/// Comparators at the terminals; used only if control.sensorless.follows names them.
struct Comparators {
  std::optional<double> bandwidth_Hz;
  rig::CrossingReference against = rig::CrossingReference::virtual_star;
  std::vector<double> offset_V{};  // three values, for terminals a, b, c
  double hysteresis_V = 0.0;
  bool operator==(const Comparators&) const = default;
};

struct Sensors {
  rig::CurrentMeasurement currents = rig::CurrentMeasurement::ideal;
  int adc_bits = 12;
  std::optional<double> current_range_A;
  double current_offset_A = 0.0;
  double current_gain_error = 0.0;
  double current_noise_A = 0.0;
  std::optional<double> current_bandwidth_Hz;
  double current_delay_s = 0.0;
  bool calibrated = true;
  ShuntLegs shunts = ShuntLegs::abc;
  double shunt_settle_s = 1e-6;
  double shunt_least_on_s = 0.0;
  int commutation_samples = 4;
  BusSensing bus = BusSensing::ideal;
  std::optional<double> bus_range_V;
  double bus_offset_V = 0.0;
  double bus_gain_error = 0.0;
  double bus_noise_V = 0.0;
  std::optional<double> bus_bandwidth_Hz;
  std::vector<double> terminal_gain_error{};  // three values, for terminals a, b, c
  RotorSensing rotor = RotorSensing::ideal;
  double capture_Hz = 1e6;
  int speed_edges = 0;  // Hall edges over which a speed is averaged; 0: six if the speed loop tolerates the
                        // delay of six edges, else one
  rig::HallAngleFrom hall_angle = rig::HallAngleFrom::sectors;
  int hall_calibration_turns = 8;
  double timeout_s = 0.05;
  int hall_stable_samples = 1;
  int seed = 0;
  rig::WireOrder hall_lines = rig::WireOrder::abc;  // probes at pins H1, H2, H3
  HallLines hall_inverted = HallLines::none;
  control::HallArrangement hall_spacing = control::HallArrangement::degrees_120;
  double hall_offset_deg = 0.0;
  std::vector<double> hall_edges_deg{};  // 6 values, or 6 p for p pole pairs
  double hall_hysteresis_deg = 0.0;
  double hall_delay_s = 0.0;
  double hall_glitches_Hz = 0.0, hall_glitch_s = 1e-6;
  SensorShaft shaft = SensorShaft::motor;
  bool watched = true;
  Encoder encoder;
  AbsoluteEncoder absolute;
  Resolver resolver;
  Comparators comparators;
  HallBreak hall_break;
};

}  // namespace sixstep::study
