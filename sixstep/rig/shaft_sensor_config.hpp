// SPDX-License-Identifier: Apache-2.0
// What stands on a shaft in the place of Hall probes, or beside them on the load's side (model.md 10): as an engineer says it, as
// a board is told, and what it gives where the shaft stands. Whoever asks, the drive's peripherals or a trace, asks here.
#pragma once
#include <cstdint>
#include <optional>

#include "sixstep/control/sensing/tracking.hpp"
#include "sixstep/plant/resolver.hpp"
#include "sixstep/rig/shaft_watch.hpp"

namespace sixstep::rig {

enum class ShaftSensor : std::uint8_t { none, encoder, absolute, resolver };

/// Who makes an angle of a resolver's windings: the drive's own converter and loop, or a chip beside it.
enum class ResolverReading : std::uint8_t { sampled, tracking };

struct Encoder {
  static constexpr int usual_lines = 1024;
  int lines = usual_lines;         ///< of a turn
  std::optional<double> pitch_mm;  ///< of a linear motor's, in their place
  bool referenced = true;          ///< its index was passed before the run
  double missed_Hz = 0.0;
};
struct AbsoluteEncoder {
  int bits = 14;
  double latency_s = 0.0;  ///< latched so long before it is read
  int speed_samples = 8;   ///< that its speed is taken over
};
struct Resolver {
  int pole_pairs = 1;
  double amplitude_V = 2.0;
  double excitation_Hz = 10e3;
  double imbalance = 0.0;
  double quadrature_deg = 0.0;
  double phase_deg = 0.0;
  std::optional<double> sine_phase_deg;  ///< where it is another than the cosine's
  bool calibrated = false;               ///< sampled: the decoder takes off what the windings are unlike by
  double noise_V = 0.0;                  ///< of the windings, root mean square
  double bandwidth_Hz = 1000.0;
  double damping = 1.0;
  int bits = 16;
  ResolverReading reading = ResolverReading::sampled;
  double converter_Hz = 500e3;  ///< tracking: clock of the chip's loop
  double latency_s = 0.0;       ///< tracking: latched so long before it is read
};

/// Its windings alone, in SI.
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
  bool on_load = false;  ///< behind gear and coupling; the Hall probes commutate
  double gear = 1.0;     ///< turns of the motor to one of the load
  /// Along a line: a turn is the magnets' period, the encoder's `lines` are those of it, `gear` is 1 over those to a metre, and the
  /// index stands at 0 alone.
  bool linear = false;
  bool watched = false;  ///< the drive ends where the sensor shows what a whole one cannot
  Encoder encoder{};
  AbsoluteEncoder absolute{};
  Resolver resolver{};
  int samples_per_peak =
      1;  ///< of a sampled resolver: control ticks from one peak of the excitation to the next
  control::TrackingConfig tracking{};
  ResolverWatch watch{};

  /// Quarters of lines to a turn.
  std::int64_t quarters() const { return 4 * std::int64_t{encoder.lines}; }
};

/// In which quarter of a line an encoder shows the shaft, counted over all turns.
template <class Real>
std::int64_t encoder_quarter(const ShaftSensorConfig& given, const plant::ShaftAngle<Real>& at) {
  return plant::encoder_quarter(at, given.encoder.lines);
}

/// The Gray code that an absolute encoder shows.
template <class Real>
std::uint32_t absolute_code(const ShaftSensorConfig& given, const plant::ShaftAngle<Real>& at) {
  return plant::gray_code(at, given.absolute.bits);
}

}  // namespace sixstep::rig
