// SPDX-License-Identifier: Apache-2.0
// Absolute encoder in Gray code, with up to 20 tracks: decodes angle, turns and speed. A motion that the
// rotor's inertia makes impossible is a fault. The faulty track is reported if it is unambiguous.
//
//   binary = g ^ g >> 1 ^ g >> 2 ^ ...,   angle = binary 2^(32-n),   w = (angle - angle k ticks ago)/(k T)
//
// g: code, n: number of tracks, T: control period. A wrong track j inverts the bits j to 0: the angle is
// mirrored within 2^(j+1) counts. When the rotor leaves these counts, the angle seems to jump by up to
// 2^(j+1) counts. Each angle is therefore compared with the prediction from the last two angles. If the
// difference exceeds the effects of acceleration and rounding, the code is faulty. The faulty track is the
// track whose inversion results in the predicted angle.
//
// Mirrored motion is detected at a jump, or if it exceeds the tolerance in one tick. With a slow rotor the
// fault is not detected before the jump. A fault of the top track is never detected, because the mirrored
// range of this track has no border.
#pragma once
#include <cstdint>

#include "sixstep/control/sensing/binary_angle.hpp"

namespace sixstep::control {

inline constexpr std::uint8_t no_track = 0xff;

/// Default: the angle is 0.
template <class Scalar>
struct GrayConfig {
  std::uint8_t bits = 0;          ///< n, 1..20; bit 0 of a code is the finest track
  BinaryAngle tolerance = 0;      ///< largest error of the predicted angle: 2 counts plus the effect of
                                  ///< acceleration, below an eighth of a turn; 0: not checked
  std::uint8_t patience = 0;      ///< number of consecutive bad codes that the prediction replaces; the next
                                  ///< code is accepted
  std::uint8_t span = 1;          ///< k, 1..8 ticks over which the speed is measured
  Gain<Scalar> speed_per_unit{};  ///< 2 pi/(2^32 k T) divided by the base of speeds, with k = span; in fixed
                                  ///< point: raw digits
  bool operator==(const GrayConfig&) const = default;
};

struct GrayState {
  BinaryAngle past[9]{};  ///< angles of the last ticks, newest first
  UnwrappedAngle position{};
  std::uint8_t known = 0;    ///< number of valid entries of `past`
  std::uint8_t bad = 0;      ///< consecutive bad codes
  std::uint32_t faults = 0;  ///< bad codes in total
};

template <class Scalar>
struct GrayReading {
  UnwrappedAngle position{};
  Scalar speed{};                 ///< 0 until span + 1 codes were read
  bool jump = false;              ///< true: this code was impossible; the prediction replaces at most
                                  ///< `patience` codes
  std::uint8_t track = no_track;  ///< the faulty track, if exactly one track explains the jump
};

/// Converts a Gray code to binary. Bits from `bits` upwards are ignored.
constexpr std::uint32_t binary_of_gray(std::uint32_t gray, std::uint8_t bits) {
  std::uint32_t b = bits >= 32 ? gray : gray & ((std::uint32_t{1} << bits) - 1u);
  for (std::uint8_t by = 1; by < 32; by = static_cast<std::uint8_t>(2 * by)) b ^= b >> by;
  return b;
}

constexpr std::uint32_t gray_of_binary(std::uint32_t binary) { return binary ^ (binary >> 1); }

constexpr BinaryAngle angle_of_gray(std::uint32_t gray, std::uint8_t bits) {
  if (bits == 0 || bits > 20) return 0;
  return binary_of_gray(gray, bits) << (32 - bits);
}

namespace detail {

constexpr bool within(BinaryAngle angle, BinaryAngle of, BinaryAngle tolerance) {
  return absolute(way_between(of, angle)) <= tolerance;
}

/// The only track whose inversion results in the predicted angle; no_track if no track or more than one track
/// does. Wrong earlier codes within the tolerance may have changed the prediction. The track must therefore
/// be the only track that explains the code within four times the tolerance.
///
/// Test with 12 tracks that break at 4 to 20 counts per tick, with a tolerance of 3 counts: two of three
/// faults are identified from the fifth track on, none in the finer tracks. In 8820 faults no wrong track is
/// identified (tests/control/sensing/gray_test.cpp). With three times the tolerance, 42 wrong tracks would be
/// identified.
constexpr std::uint8_t wrong_track(std::uint32_t gray, std::uint8_t bits, BinaryAngle foretold,
                                   BinaryAngle tolerance) {
  std::uint8_t found = no_track;
  for (std::uint8_t k = 0; k < bits; ++k) {
    if (!within(angle_of_gray(gray ^ (std::uint32_t{1} << k), bits), foretold, 4 * tolerance)) continue;
    if (found != no_track) return no_track;
    found = k;
  }
  return found;
}

}  // namespace detail

/// One reading. Call it once per tick, at equal intervals.
template <class Scalar>
constexpr GrayReading<Scalar> gray_step(const GrayConfig<Scalar>& config, GrayState& state,
                                        std::uint32_t code) {
  GrayReading<Scalar> reading{};
  BinaryAngle angle = angle_of_gray(code, config.bits);
  const BinaryAngle foretold = state.past[0] + (state.past[0] - state.past[1]);
  const bool checked = config.tolerance != 0 && state.known >= 2;
  reading.jump = checked && !detail::within(angle, foretold, config.tolerance);
  if (reading.jump) {
    reading.track = detail::wrong_track(code, config.bits, foretold, config.tolerance);
    ++state.faults;
    if (state.bad < 255) ++state.bad;
    if (state.bad <= config.patience)
      angle = foretold;
    else
      state.known = 0;  // the prediction has failed: restarts with this code
  } else {
    state.bad = 0;
  }
  if (state.known == 0 && !reading.jump)
    state.position.angle = angle;  // the first code does not count as a turn
  for (int n = 8; n > 0; --n) state.past[n] = state.past[n - 1];
  state.past[0] = angle;
  if (state.known < 9) ++state.known;
  unwrap(state.position, angle);
  reading.position = state.position;
  const std::uint8_t k = config.span < 1 ? std::uint8_t{1} : config.span > 8 ? std::uint8_t{8} : config.span;
  if (state.known > k)
    reading.speed =
        AngleTraits<Scalar>::scaled(way_between(state.past[k], state.past[0]), config.speed_per_unit);
  return reading;
}

}  // namespace sixstep::control
