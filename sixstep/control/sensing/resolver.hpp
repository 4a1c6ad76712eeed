// SPDX-License-Identifier: Apache-2.0
// Resolver: computes the rotor's angle from two windings, sampled at the peaks of their excitation.
//
//   V_c = k V sin(w_x t + d) cos phi,   V_s = (1 + a) k V sin(w_x t + d) sin(phi + q),   phi = p_r theta_m
//
//   demodulated   x = +-(this sample - the sample half a period before)/2, without the converter's offset. x
//                 is valid for the middle between both samples, a quarter of a period ago.
//   corrected     c = g_c x_c - o_c,   s = g_s x_s - o_s - tan q c,   g_s = g_c/((1 + a) cos q)
//   detected      with an estimate theta:  along = c cos theta + s sin theta = A cos(phi - theta)
//                                          across = s cos theta - c sin theta = A sin(phi - theta)
//                 error = across/along = tan(phi - theta), for any amplitude A; or across, for A = 1
//   tracked       tracking.hpp
//
// V_c, V_s: voltages of the windings, V, w_x, d: amplitude, frequency and phase of the excitation, k: ratio,
// a, q: errors of amplitude and angle, p_r: pole pairs. g_c, g_s are gains, o_c, o_s offsets. Beyond 45
// degrees (90 without normalising) the error is 1 with the sign of the shorter rotation. The loop therefore
// cannot settle with an error of half a turn.
#pragma once
#include <cstdint>

#include "sixstep/control/sensing/sine.hpp"
#include "sixstep/control/sensing/tracking.hpp"

namespace sixstep::control {

/// In fixed point choose an amplitude of at most 0.7: its square then fits, with a margin for faults.
template <class Scalar>
struct ResolverConfig {
  Gain<Scalar> cos_per_count{};  ///< g_c/2, per count of difference between two samples; in fixed point: raw
                                 ///< digits
  Gain<Scalar> sin_per_count{};  ///< g_s/2, like cos_per_count
  Scalar cos_offset{};           ///< o_c, the offset that remains after demodulation
  Scalar sin_offset{};           ///< o_s, like cos_offset
  Gain<Scalar> skew{};           ///< tan q, for windings that are not at right angles
  bool normalise = true;         ///< true: divides by the measured amplitude; false: assumes the amplitude 1
  TrackingConfig loop{};
  Scalar least_square{};        ///< least c^2 + s^2; below it a winding or the excitation is broken
  Scalar greatest_square{};     ///< greatest c^2 + s^2; above it the windings are shorted to each other; 0:
                                ///< not checked
  std::uint8_t lost_after = 1;  ///< number of consecutive results outside of the two bounds after which
                                ///< `lost` is true
  bool operator==(const ResolverConfig&) const = default;
};

/// Converter counts of both windings at one peak.
struct ResolverCounts {
  std::uint16_t cos = 0, sin = 0;
};

template <class Scalar>
struct ResolverSignals {
  Scalar c{}, s{};
};

struct ResolverState {
  ResolverCounts last{};
  TrackingState loop{};
  std::uint8_t outside = 0;
  bool begun = false;  ///< true: `last` contains a sample
};

template <class Scalar>
struct ResolverReading {
  BinaryAngle angle = 0;   ///< angle within the resolver's turn (p_r turns per mechanical turn), in the
                           ///< middle between the two samples
  std::int32_t speed = 0;  ///< units of 2^-32 turn per call
  Scalar square{};         ///< c^2 + s^2
  bool lost = false;
};

/// Signals from two consecutive samples. positive_peak: true if `now` was sampled at the positive peak.
template <class Scalar>
constexpr ResolverSignals<Scalar> resolver_signals(const ResolverConfig<Scalar>& config,
                                                   const ResolverCounts& before, const ResolverCounts& now,
                                                   bool positive_peak) {
  using T = ScalarTraits<Scalar>;
  const std::int32_t sign = positive_peak ? 1 : -1;
  const auto between_them = [sign](std::uint16_t a, std::uint16_t b) {
    return static_cast<std::int32_t>(sign * (static_cast<std::int32_t>(b) - static_cast<std::int32_t>(a)));
  };
  const Scalar c = AngleTraits<Scalar>::scaled(between_them(before.cos, now.cos), config.cos_per_count) -
                   config.cos_offset;
  const Scalar s = AngleTraits<Scalar>::scaled(between_them(before.sin, now.sin), config.sin_per_count) -
                   config.sin_offset;
  return {c, s - T::product(c, config.skew)};
}

/// The phase detector: approximately phi - theta, as a signed angle.
template <class Scalar>
constexpr std::int32_t resolver_error(const ResolverSignals<Scalar>& x, BinaryAngle theta, bool normalise) {
  const Direction<Scalar> d = direction_of<Scalar>(theta);
  const Scalar along = x.c * d.cos + x.s * d.sin;
  const Scalar across = x.s * d.cos - x.c * d.sin;
  const Scalar limit = normalise ? magnitude(across) : Scalar{};
  // `along` must be strictly greater: otherwise a resolver without signals (0/0) would have an error of 1
  // instead of 0.
  if (along > limit) return angle_of_rad(normalise ? across / along : across);
  if (along == Scalar{} && across == Scalar{}) return 0;
  return angle_of_rad(across < Scalar{} ? -one<Scalar> : one<Scalar>);
}

/// One sample. Call it once per peak of the excitation. Alternatively call it once per period with
/// `positive_peak` always true, and call resolver_hold with the negative peak's counts. At the first sample
/// the reading is 0.
template <class Scalar>
constexpr ResolverReading<Scalar> resolver_step(const ResolverConfig<Scalar>& config, ResolverState& state,
                                                const ResolverCounts& counts, bool positive_peak) {
  const ResolverCounts before = state.last;
  state.last = counts;
  if (!state.begun) {
    state.begun = true;
    return {};
  }
  const ResolverSignals<Scalar> x = resolver_signals(config, before, counts, positive_peak);
  const Scalar square = x.c * x.c + x.s * x.s;
  const bool high = config.greatest_square > Scalar{} && square > config.greatest_square;
  if (square < config.least_square || high) {
    if (state.outside < 255) ++state.outside;
  } else {
    state.outside = 0;
  }
  const std::int32_t error = resolver_error(x, state.loop.angle, config.normalise);
  const BinaryAngle angle = state.loop.angle;  // predicted for this sample
  tracking_step(config.loop, state.loop, error);
  const std::uint8_t patience = config.lost_after == 0 ? std::uint8_t{1} : config.lost_after;
  return {angle, tracking_speed(state.loop), square, state.outside >= patience};
}

/// Stores the counts of the negative peak, for a loop that is executed once per period.
constexpr void resolver_hold(ResolverState& state, const ResolverCounts& counts) {
  state.last = counts;
  state.begun = true;
}

}  // namespace sixstep::control
