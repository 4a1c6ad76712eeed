// SPDX-License-Identifier: Apache-2.0
// What the board measures with, as a scenario says it. The default is ideal throughout. What each key means
// stands in sensors_description.hpp.
#pragma once
#include <cstdint>
#include <optional>

#include "sixstep/rig/sensors.hpp"

namespace sixstep::study {

enum class BusSensing : std::uint8_t { ideal, adc };
enum class RotorSensing : std::uint8_t { ideal, hall };
enum class Level01 : std::uint8_t { low, high };

/// A Hall line that breaks.
struct HallBreak {
  std::optional<double> at_s;
  int line = 1;
  Level01 level = Level01::low;
};

struct Sensors {
  rig::CurrentMeasurement currents = rig::CurrentMeasurement::ideal;
  int adc_bits = 12;
  std::optional<double> current_range_A;
  double current_offset_A = 0.0;
  double current_gain_error = 0.0;
  double current_noise_A = 0.0;
  bool calibrated = true;
  double shunt_settle_s = 1e-6;
  int commutation_samples = 4;
  BusSensing bus = BusSensing::ideal;
  std::optional<double> bus_range_V;
  double bus_offset_V = 0.0;
  double bus_gain_error = 0.0;
  double bus_noise_V = 0.0;
  RotorSensing rotor = RotorSensing::ideal;
  double capture_Hz = 1e6;
  int speed_edges = 0;  // 0: six where the speed loop stands their delay, else one
  double timeout_s = 0.05;
  int hall_stable_samples = 1;
  int seed = 0;
  HallBreak hall_break;
};

}  // namespace sixstep::study
