// SPDX-License-Identifier: Apache-2.0
// Checks by the zero crossing of each sector whether the commutation still follows the rotor, and determines
// the cause of a loss. A loss is detected within two commutations of its cause.
//
//   masked crossing        no crossing within `window` of the sector's expected time
//   long demagnetisation   the old current hid the crossing, in `tolerated` consecutive sectors or for a
//                          whole window
//   wrong sector           one of these:
//                          - in `tolerated` consecutive sectors the crossing had already passed when the old
//                            current had ended
//                          - in `tolerated` consecutive sectors the time between crossings was below 5/8
//                            or above 8/5 of the previous time, or shorter than possible at this bus voltage
//                          - in `unlike_samples` consecutive samples the back-EMF had its old sign again
//                            after the crossing, or was larger than at the assumed speed:
//                            2 u_f - u_s - u_k times T is at most 3 K_e (pi/3)/p
//   terminals              the driven legs' terminals contradict the command: a divider or its wire is broken
//   start                  the ramp ended without enough trusted crossings
#pragma once
#include <cstdint>

#include "sixstep/control/sensorless/commutation_clock.hpp"
#include "sixstep/control/sensorless/zero_crossing.hpp"

namespace sixstep::control {

enum class LockLoss : std::uint8_t {
  none,
  masked_crossing,
  long_demagnetisation,
  wrong_sector,
  terminals,
  start
};

struct LockConfig {
  std::uint8_t window_eighths = 16;          ///< window in eighths of a sector, from crossing to crossing
  std::uint8_t tolerated = 2;                ///< consecutive sectors without a crossing at which a loss is
                                             ///< reported
  std::uint8_t unlike_samples = 4;           ///< number of consecutive contradicting samples at which a loss
                                             ///< is reported
  std::uint32_t shortest_ticks = 0;          ///< shortest possible sector, at the largest speed
  std::uint32_t longest_ticks = 0xffffffff;  ///< longest sector of a rotor that can be followed
  std::uint32_t most_flux = 0xffffffff;      ///< largest y times T of a rotor, counts times ticks
  std::int32_t threshold = 0x7fffffff;       ///< counts of |y| above which y counts as a voltage, not as
                                             ///< noise
  std::uint8_t retries = 3;                  ///< consecutive losses and failed starts before the drive stops
  std::uint16_t sectors_to_forget = 60;      ///< sectors without a loss after which the count of losses is
                                             ///< reset
  bool operator==(const LockConfig&) const = default;
};

struct LockState {
  std::uint8_t hidden = 0;  ///< consecutive sectors whose crossing the old current hid
  std::uint8_t early = 0;   ///< consecutive sectors whose crossing had passed before it could be detected
  std::uint8_t odd = 0;     ///< consecutive samples that are impossible in this sector at this speed
  std::uint8_t jumps = 0;   ///< consecutive sectors whose time differed too much from the sector before
  std::uint8_t losses = 0;  ///< consecutive losses
  std::uint16_t held = 0;   ///< number of sectors since the last loss
  LockLoss last = LockLoss::none;
};

/// Starts the supervision.
constexpr void lock_begin(LockState& state) {
  state.hidden = 0;
  state.early = 0;
  state.jumps = 0;
  state.odd = 0;
  state.held = 0;
}

/// True if a sector of `interval` ticks is possible after a sector of T ticks.
constexpr bool follows_on(std::uint32_t interval, std::uint32_t T) {
  return interval / 5 >= T / 8 && interval / 8 <= T / 5;
}

/// Checks a sector whose crossing was found, or had passed. `interval`: ticks since the previous crossing. T:
/// ticks of a sector, 0 if the previous crossing was not found. `hidden`: the old current still decayed at
/// the crossing.
constexpr LockLoss lock_crossing(const LockConfig& config, LockState& state, Crossing crossing,
                                 std::uint32_t interval, std::uint32_t T, bool hidden) {
  if (crossing == Crossing::seen && interval >= config.shortest_ticks) {
    state.hidden = 0;
    state.early = 0;
    if (T != 0 && !follows_on(interval, T))
      return ++state.jumps < config.tolerated ? LockLoss::none : LockLoss::wrong_sector;
    state.jumps = 0;
    if (state.held < config.sectors_to_forget)
      ++state.held;
    else
      state.losses = 0;
    return LockLoss::none;
  }
  if (crossing == Crossing::passed_before && hidden)
    return ++state.hidden < config.tolerated ? LockLoss::none : LockLoss::long_demagnetisation;
  return ++state.early < config.tolerated ? LockLoss::none : LockLoss::wrong_sector;
}

/// Checks a sample y of the back-EMF. `crossed`: true after the crossing of this sector.
constexpr LockLoss lock_sample(const LockConfig& config, LockState& state, std::int32_t y, bool crossed,
                               std::uint32_t T) {
  const std::uint32_t size = static_cast<std::uint32_t>(y < 0 ? -y : y);
  const bool came_back = crossed && y > config.threshold;
  const bool too_large =
      T != 0 && size > static_cast<std::uint32_t>(config.threshold) && size > config.most_flux / T;
  if (!came_back && !too_large) {
    state.odd = 0;
    return LockLoss::none;
  }
  return ++state.odd < config.unlike_samples ? LockLoss::none : LockLoss::wrong_sector;
}

/// Checks a sector whose crossing is missing. `since`: ticks since the last crossing. T: ticks of a sector.
/// `hides`: the old current still flows.
constexpr LockLoss lock_waiting(const LockConfig& config, std::uint32_t since, std::uint32_t T, bool hides,
                                std::uint8_t unlike_samples) {
  if (unlike_samples >= config.unlike_samples) return LockLoss::terminals;
  const std::uint32_t eighth = T / 8, most = config.longest_ticks;
  const std::uint32_t window = eighth < most / config.window_eighths ? eighth * config.window_eighths : most;
  if (since <= window) return LockLoss::none;
  return hides ? LockLoss::long_demagnetisation : LockLoss::masked_crossing;
}

/// Counts a loss. Returns true if the drive must stop, after more than config.retries losses.
constexpr bool lock_lost(const LockConfig& config, LockState& state, LockLoss loss) {
  lock_begin(state);
  state.last = loss;
  if (state.losses < 255) ++state.losses;
  return state.losses > config.retries;
}

}  // namespace sixstep::control
