// SPDX-License-Identifier: Apache-2.0
// Configuration of a sensor on the shaft (model.md 10), and the sensor's output at an angle. On the motor's
// shaft the sensor replaces the Hall probes. On the load's shaft it is additional to the Hall probes.
#pragma once
#include <cmath>
#include <cstdint>
#include <optional>

#include "sixstep/control/sensing/tracking.hpp"
#include "sixstep/plant/resolver.hpp"
#include "sixstep/rig/shaft_watch.hpp"

namespace sixstep::rig {

enum class ShaftSensor : std::uint8_t { none, encoder, absolute, resolver };

/// Source of a resolver's angle. sampled: converter and tracking loop of the drive; tracking: a tracking
/// converter.
enum class ResolverReading : std::uint8_t { sampled, tracking };

struct Encoder {
  static constexpr int usual_lines = 1024;
  int lines = usual_lines;         ///< lines per turn
  std::optional<double> pitch_mm;  ///< pitch of a linear motor's scale, instead of lines
  bool referenced = true;          ///< true: the index was passed before the run
  double missed_Hz = 0.0;
  double offset_deg = 0.0;  ///< mounting error: angle shown by the sensor minus the rotor's angle, electrical
                            ///< degrees
};
struct AbsoluteEncoder {
  int bits = 14;
  double latency_s = 0.0;   ///< time from the latching of the code to its reading
  int speed_samples = 8;    ///< samples over which the speed is averaged
  double offset_deg = 0.0;  ///< mounting error, like Encoder::offset_deg
};
struct Resolver {
  int pole_pairs = 1;
  double amplitude_V = 2.0;
  double excitation_Hz = 10e3;
  double imbalance = 0.0;
  double quadrature_deg = 0.0;
  double phase_deg = 0.0;
  std::optional<double> sine_phase_deg;  ///< phase of the sine winding, if it differs from that of the cosine
                                         ///< winding
  bool calibrated = false;               ///< for `sampled`, true: the decoder corrects the differences
                                         ///< between the windings
  double noise_V = 0.0;                  ///< rms noise of each winding
  double bandwidth_Hz = 1000.0;
  double damping = 1.0;
  int bits = 16;
  ResolverReading reading = ResolverReading::sampled;
  double converter_Hz = 500e3;  ///< for `tracking`: clock frequency of the converter's loop
  double latency_s = 0.0;       ///< for `tracking`: time from the latching of the angle to its reading
  double offset_deg = 0.0;      ///< mounting error, like Encoder::offset_deg
};

/// The resolver's windings, in SI units.
inline plant::Resolver windings_of(const Resolver& r) {
  constexpr double deg = base::pi / 180;
  return {.amplitude_V = r.amplitude_V,
          .excitation_Hz = r.excitation_Hz,
          .pole_pairs = r.pole_pairs,
          .imbalance = r.imbalance,
          .quadrature_rad = r.quadrature_deg * deg,
          .phase_1_rad = r.phase_deg * deg,
          .phase_2_rad = r.sine_phase_deg.value_or(r.phase_deg) * deg};
}

struct ShaftSensorConfig {
  ShaftSensor kind = ShaftSensor::none;
  bool on_load = false;  ///< true: the sensor is on the load's shaft, and the Hall probes determine the
                         ///< commutation
  double gear = 1.0;     ///< turns of the motor per turn of the load
  /// True for a linear sensor. A turn is then one period of the magnets (two pole pitches), and `lines` are
  /// per period. `gear` is the length of the period in m, divided by 2 pi. There is one index, at 0.
  bool linear = false;
  bool watched = false;  ///< true: the drive stops if the sensor shows values that are impossible with an
                         ///< intact sensor
  Encoder encoder{};
  AbsoluteEncoder absolute{};
  Resolver resolver{};
  double offset_deg = 0.0;           ///< mounting error of the sensor, electrical degrees of the motor
  double believed_offset_deg = 0.0;  ///< offset that the drive subtracts
  int believed_pole_pairs = 0;       ///< the motor's pole pairs that the drive assumes; 0: the true number
  int samples_per_peak = 1;  ///< sampled resolver: control ticks from one peak of the excitation to the next
  control::TrackingConfig tracking{};
  ResolverWatch watch{};

  /// Quarters of lines per turn.
  std::int64_t quarters() const { return 4 * std::int64_t{encoder.lines}; }
};

/// The angle that a sensor with a mounting error of `offset_deg` electrical degrees shows for the shaft's
/// angle `at`. Without an offset all bits are unchanged.
template <class Real>
plant::ShaftAngle<Real> mounted(double offset_deg, plant::ShaftAngle<Real> at) {
  if (offset_deg == 0.0) return at;
  const double sectors = std::floor(offset_deg / 60);
  at.sector += static_cast<std::int64_t>(sectors);
  at.x += static_cast<Real>((offset_deg - 60 * sectors) * (base::pi / 180));
  return at;
}

/// Quarter of a line that an encoder shows, counted over all turns.
template <class Real>
std::int64_t encoder_quarter(const ShaftSensorConfig& given, const plant::ShaftAngle<Real>& at) {
  return plant::encoder_quarter(mounted(given.offset_deg, at), given.encoder.lines);
}

/// Gray code of an absolute encoder.
template <class Real>
std::uint32_t absolute_code(const ShaftSensorConfig& given, const plant::ShaftAngle<Real>& at) {
  return plant::gray_code(mounted(given.offset_deg, at), given.absolute.bits);
}

}  // namespace sixstep::rig
