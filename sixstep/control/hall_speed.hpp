// SPDX-License-Identifier: Apache-2.0
// Computes speed, angle within the sector and position from the times of Hall edges.
//
//   w = +-k (pi/3)/p timer_Hz/(ticks over the last k edges)
//   |w| <= (pi/3)/p timer_Hz/(ticks since the last edge)     because the next edge has not occurred yet
//   fraction = ticks since the last edge/mean ticks of a sector, at most 1
//
// w: mechanical speed, p: pole pairs. Times are readings of a free-running 32-bit counter that may wrap
// (extend a 16-bit capture register by the number of its overflows). The first edge, a reversal and a
// time-out restart the history with speed 0, because a speed needs two edges.
//
// A speed over k edges has an age of k/2 sectors at an edge, and of k/2 + 1 sectors before the next edge. Its
// mean delay is (k + 1)/2 sectors, or (k + 1)/2 (pi/3)/(p w). The probes' placement errors cancel over k = 6,
// one electrical turn. At low speed, however, this delay makes a speed loop unstable. With a window, the
// speed is measured over `edges` edges if they occurred within the window, else over one edge.
#pragma once
#include <cstdint>

#include "sixstep/control/fixed.hpp"
#include "sixstep/control/hall.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

/// Default: the speed is always 0.
template <class Scalar>
struct HallSpeedConfig {
  TickRatio<Scalar> sector_rad_s_ticks{};  ///< (pi/3)/p timer_Hz: product of speed and ticks of one sector
  std::uint32_t timeout_ticks = 0;  ///< ticks without an edge after which the rotor counts as at rest; below
                                    ///< 2^32 minus one control period
  std::uint8_t edges = 1;           ///< k, edges over which the speed is measured, 1..6
  std::uint32_t window_ticks = 0;   ///< k = 1 if `edges` edges took longer than this; 0: k is always `edges`
  std::uint32_t grain_ticks = 1;    ///< resolution of an edge's time: 1 with capture; with polling, the timer
                                    ///< ticks of a control period
  bool operator==(const HallSpeedConfig&) const = default;
};

struct HallSpeedState {
  std::uint32_t times[7]{};   ///< times of the last edges, newest first
  std::uint8_t known = 0;     ///< number of valid entries of `times`, all in one direction
  std::int8_t direction = 0;  ///< direction of the last edge
};

constexpr std::uint8_t hall_speed_edges(std::uint8_t wanted, std::uint8_t known) {
  const std::uint8_t most = wanted < 1 ? 1 : wanted > 6 ? 6 : wanted;
  const std::uint8_t intervals = known > 0 ? static_cast<std::uint8_t>(known - 1) : std::uint8_t{0};
  return intervals < most ? intervals : most;
}

/// Number of sectors over which the speed is measured now; 0: no speed is available yet.
template <class Scalar>
constexpr std::uint8_t hall_speed_sectors(const HallSpeedConfig<Scalar>& config,
                                          const HallSpeedState& state) {
  const std::uint8_t k = hall_speed_edges(config.edges, state.known);
  if (k < 2 || config.window_ticks == 0) return k;
  return static_cast<std::uint32_t>(state.times[0] - state.times[k]) > config.window_ticks ? std::uint8_t{1}
                                                                                           : k;
}

/// Adds an edge in `direction` (+1, -1) at counter reading `now`.
constexpr void hall_speed_edge(HallSpeedState& state, std::uint32_t now, std::int8_t direction) {
  if (direction == 0) return;
  if (direction != state.direction) state.known = 0;
  state.direction = direction;
  for (int n = 6; n > 0; --n) state.times[n] = state.times[n - 1];
  state.times[0] = now;
  if (state.known < 7) ++state.known;
}

/// Speed at counter reading `now`, mechanical rad/s. Call hall_speed() at least once per timeout_ticks,
/// because only this call detects standstill.
template <class Scalar>
constexpr Scalar hall_speed(const HallSpeedConfig<Scalar>& config, HallSpeedState& state, std::uint32_t now) {
  using T = ScalarTraits<Scalar>;
  if (state.known == 0) return Scalar{};
  const std::uint32_t since = static_cast<std::uint32_t>(now - state.times[0]);
  if (since > config.timeout_ticks) {
    state.known = 0;
    state.direction = 0;
    return Scalar{};
  }
  const std::uint8_t k = hall_speed_sectors(config, state);
  if (k == 0) return Scalar{};
  const std::uint32_t ticks = static_cast<std::uint32_t>(state.times[0] - state.times[k]);
  Scalar w = T::per_ticks(T::times(config.sector_rad_s_ticks, k), ticks == 0 ? 1 : ticks);
  // Only after the mean time of a sector can the bound be below the measured speed.
  if (since > ticks / k) {
    const Scalar bound = T::per_ticks(config.sector_rad_s_ticks, since);
    if (bound < w) w = bound;
  }
  return state.direction < 0 ? -w : w;
}

/// True if the times of two sectors differ by at most a quarter.
constexpr bool alike(std::uint32_t later, std::uint32_t earlier) {
  return later <= earlier + earlier / 4 && later >= earlier - earlier / 4;
}

/// Compares the time since the last edge with the times of the last sectors. The result is `unknown` before
/// five edges in one direction, or if successive sector times differ by more than a quarter.
///
/// A rotor that starts from rest at a constant torque (sector times 1, 0.41, 0.32, 0.27, 0.24) has no edge
/// that is `soon`. A rotor that slows down at a constant torque has no edge that is `twice`, and no two
/// sectors that are `within`. If a sector's time T is less than eight grains g, the result is `unknown`. For
/// T >= 8 g, the ratio (T - g)/(T + g) of two measured times at steady speed is at least 3/4.
constexpr SectorTime sector_time(const HallSpeedState& state, std::uint32_t grain, std::uint32_t now) {
  if (state.known < 5) return SectorTime::unknown;
  const std::uint32_t since = static_cast<std::uint32_t>(now - state.times[0]);
  std::uint32_t sector[3]{};
  for (int n = 0; n < 3; ++n) {
    sector[n] = static_cast<std::uint32_t>(state.times[n] - state.times[n + 1]);
    if (sector[n] > 0x3fffffff) return SectorTime::unknown;  // 2.5 times this time would overflow
  }
  const std::uint32_t last = sector[0];
  if (last / 8 < grain) return SectorTime::unknown;
  if (!alike(last, sector[1]) || !alike(sector[1], sector[2])) return SectorTime::unknown;
  if (since < last - last / 4) return SectorTime::soon;
  if (since <= last + last / 4) return SectorTime::within;
  const bool twice = since >= last + last / 2 + last / 4 && since <= 2 * last + last / 2;
  return twice ? SectorTime::twice : SectorTime::unknown;
}

/// Distance since the last edge in the direction of rotation, 0..1 sector; 1/2 while no speed is available.
template <class Scalar>
constexpr Scalar sector_fraction(const HallSpeedConfig<Scalar>& config, const HallSpeedState& state,
                                 std::uint32_t now) {
  using T = ScalarTraits<Scalar>;
  const std::uint8_t k = hall_speed_sectors(config, state);
  if (k == 0) return T::fraction(1, 2);
  const std::uint32_t ticks = static_cast<std::uint32_t>(state.times[0] - state.times[k]);
  return T::fraction(static_cast<std::uint32_t>(now - state.times[0]), ticks / k);
}

/// Position by counted edges. Default: the position is always 0.
template <class Scalar>
struct HallPositionConfig {
  Gain<Scalar> per_sector{};    ///< position per counted sector: 60/p degrees mechanical; fixed: raw units
  Gain<Scalar> per_fraction{};  ///< position per interpolated sector: the same number; fixed: relative to 1.0
  bool operator==(const HallPositionConfig&) const = default;
};

struct HallPositionState {
  std::int32_t sectors = 0;  ///< edges forward minus edges backward
};

constexpr void hall_position_edge(HallPositionState& state, std::int8_t moved) { state.sectors += moved; }

/// Position, mechanical degrees. If the rotor turns forward, the distance since the last edge is added to the
/// sector's lower edge; if it turns backward, the distance is subtracted from the upper edge.
template <class Scalar>
constexpr Scalar hall_position(const HallPositionConfig<Scalar>& config, const HallPositionState& state,
                               std::int8_t direction, Scalar fraction) {
  using T = ScalarTraits<Scalar>;
  const Scalar part = T::product(fraction, config.per_fraction);
  return direction < 0 ? T::counts(state.sectors + 1, config.per_sector) - part
                       : T::counts(state.sectors, config.per_sector) + part;
}

}  // namespace sixstep::control
