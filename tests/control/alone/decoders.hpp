// SPDX-License-Identifier: Apache-2.0
// The decoders of rotor position, as firmware uses them.
#pragma once
#include "sixstep/control/sensing/gray.hpp"
#include "sixstep/control/sensing/hall_calibration.hpp"
#include "sixstep/control/sensing/pulse_speed.hpp"
#include "sixstep/control/sensing/quadrature.hpp"
#include "sixstep/control/sensing/resolver.hpp"

namespace firmware {

using namespace sixstep::control;

template <class Scalar>
struct Decoders {
  static HallAngle<Scalar> hall(const HallAngleConfig<Scalar>& config, HallAngleState& state,
                                std::uint8_t sector, std::int8_t moved, std::uint32_t captured,
                                std::uint32_t now) {
    hall_angle_edge(config, state, sector, moved, captured);
    return hall_angle(config, state, now);
  }
  static Scalar pulses(const PulseSpeedConfig<Scalar>& config, PulseSpeedState& state, std::int8_t moved,
                       std::uint32_t captured, std::uint32_t now) {
    pulse_edge(state, moved, moved, captured);
    return pulse_speed(config, state, now);
  }
  static GrayReading<Scalar> gray(const GrayConfig<Scalar>& config, GrayState& state, std::uint32_t code) {
    return gray_step(config, state, code);
  }
  static ResolverReading<Scalar> resolver(const ResolverConfig<Scalar>& config, ResolverState& state,
                                          const ResolverCounts& counts, bool positive_peak) {
    return resolver_step(config, state, counts, positive_peak);
  }
  static Scalar speed(const TrackingConfig& config, TrackingState& state, BinaryAngle measured,
                      Gain<Scalar> per_unit) {
    tracking_follow(config, state, measured);
    return tracked_speed<Scalar>(state, per_unit);
  }
  static Scalar degrees(std::int32_t angle, Gain<Scalar> per_half_turn) {
    return angle_signal<Scalar>(angle, per_half_turn);
  }
};

}  // namespace firmware
