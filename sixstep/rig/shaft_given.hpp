// SPDX-License-Identifier: Apache-2.0
// What stands on a shaft in the place of Hall probes, or beside them on the load's side (model.md 10), as a board is told.
#pragma once
#include <cstdint>

#include "sixstep/control/sensing/tracking.hpp"
#include "sixstep/plant/resolver.hpp"
#include "sixstep/rig/shaft_watch.hpp"

namespace sixstep::rig {

enum class ShaftSensor : std::uint8_t { none, encoder, absolute, resolver };

/// Who makes an angle of a resolver's windings: the drive's own converter and loop, or a chip beside it.
enum class ResolverReading : std::uint8_t { sampled, tracking };

struct ShaftGiven {
  ShaftSensor kind = ShaftSensor::none;
  bool on_load = false;    ///< behind gear and coupling; the Hall probes commutate
  double gear = 1.0;       ///< turns of the motor to one of the load
  std::int64_t lines = 0;  ///< of an incremental encoder
  /// Along a line: a turn is the magnets' period, `lines` lie in it, `gear` is 1 over those to a metre, and the index stands at 0
  /// alone.
  bool linear = false;
  bool referenced = true;  ///< its index was passed before the run
  int bits = 0;            ///< of an absolute encoder, or of a resolver's angle
  double latency_s = 0.0;  ///< of an absolute encoder or a converter chip: latched so long before it is read
  int speed_samples = 1;   ///< that the speed of an absolute encoder is taken over
  plant::Resolver resolver{};
  ResolverReading reading = ResolverReading::sampled;
  bool calibrated = false;    ///< sampled: the decoder takes off what the windings are unlike by
  double noise_V = 0.0;       ///< of a resolver's windings, root mean square
  int samples_per_peak = 1;   ///< sampled: control ticks from one peak of the excitation to the next
  double converter_Hz = 0.0;  ///< tracking: clock of the chip's loop
  control::TrackingConfig tracking{};
  bool watched = false;  ///< the drive ends where the sensor shows what a whole one cannot
  ResolverWatch watch{};
};

}  // namespace sixstep::rig
