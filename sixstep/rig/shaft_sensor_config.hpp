// SPDX-License-Identifier: Apache-2.0
// Configuration of a sensor on the shaft (model.md 10): the engineer's description, the board's data, and the
// sensor's output at an angle. The sensor replaces the Hall probes, or is on the load's side in addition to
// them. Drive peripherals and traces use the same functions.
#pragma once
#include <cmath>
#include <cstdint>
#include <optional>

#include "sixstep/control/sensing/tracking.hpp"
#include "sixstep/plant/resolver.hpp"
#include "sixstep/rig/shaft_watch.hpp"

namespace sixstep::rig {

enum class ShaftSensor : std::uint8_t { none, encoder, absolute, resolver };

/// How the angle of a resolver is obtained: by the drive's own converter and loop, or by a tracking chip.
enum class ResolverReading : std::uint8_t { sampled, tracking };

struct Encoder {
  static constexpr int usual_lines = 1024;
  int lines = usual_lines;         ///< lines per turn
  std::optional<double> pitch_mm;  ///< pitch of a linear motor's scale, instead of lines
  bool referenced = true;          ///< its index was passed before the run
  double missed_Hz = 0.0;
  double offset_deg = 0.0;  ///< mounting: electrical angle that the sensor shows above the rotor's
};
struct AbsoluteEncoder {
  int bits = 14;
  double latency_s = 0.0;   ///< time from the latching of the code to its reading
  int speed_samples = 8;    ///< samples over which the speed is averaged
  double offset_deg = 0.0;  ///< as of an encoder
};
struct Resolver {
  int pole_pairs = 1;
  double amplitude_V = 2.0;
  double excitation_Hz = 10e3;
  double imbalance = 0.0;
  double quadrature_deg = 0.0;
  double phase_deg = 0.0;
  std::optional<double> sine_phase_deg;  ///< if different from the cosine winding's phase
  bool calibrated = false;               ///< sampled: the decoder corrects the differences between the
                                         ///< windings
  double noise_V = 0.0;                  ///< rms noise of each winding
  double bandwidth_Hz = 1000.0;
  double damping = 1.0;
  int bits = 16;
  ResolverReading reading = ResolverReading::sampled;
  double converter_Hz = 500e3;  ///< tracking: clock of the chip's loop
  double latency_s = 0.0;       ///< tracking: time from the latching of the angle to its reading
  double offset_deg = 0.0;      ///< as of an encoder
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
  bool on_load = false;  ///< behind gear and coupling; the Hall probes commutate then
  double gear = 1.0;     ///< turns of the motor per turn of the load
  /// Linear sensor: a turn is one period of the magnets (two pole pitches), and `lines` are per period.
  /// `gear` is the length of the period in m, divided by 2 pi. The only index is at 0.
  bool linear = false;
  bool watched = false;  ///< the drive stops if the sensor shows values that an intact sensor cannot show
  Encoder encoder{};
  AbsoluteEncoder absolute{};
  Resolver resolver{};
  double offset_deg = 0.0;           ///< mounting of the sensor in use, electrical degrees of the motor
  double believed_offset_deg = 0.0;  ///< offset that the drive subtracts
  int believed_pole_pairs = 0;       ///< the motor's pole pairs in the drive; 0: the true ones
  int samples_per_peak = 1;  ///< sampled resolver: control ticks from one peak of the excitation to the next
  control::TrackingConfig tracking{};
  ResolverWatch watch{};

  /// Quarters of lines per turn.
  std::int64_t quarters() const { return 4 * std::int64_t{encoder.lines}; }
};

/// The shaft's angle as a sensor sees it that shows `offset_deg` electrical degrees more than the rotor's
/// angle. Without an offset all bits are the same.
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
