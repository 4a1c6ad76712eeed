// SPDX-License-Identifier: Apache-2.0
// Whether the commutation still goes with the rotor, judged by what each sector showed of its zero crossing, and what it
// was that went wrong. A loss is told within two commutations of its cause.
//
//   masked crossing        none within `window` of the sector's expected time
//   long demagnetisation   the old current hid the crossing, in `tolerated` sectors in a row or for all of a window
//   wrong sector           in `tolerated` sectors in a row the terminal showed a crossing before it could be one, or
//                          the time from one to the next jumped by more than 5/8 and 8/5, or was shorter than this motor
//                          on this bus can turn; or the back-EMF came back after its crossing, or is larger than the
//                          supposed speed makes it: 2 u_f - u_s - u_k times T is at most 3 K_e (pi/3)/p
//   terminals              the driven legs' terminals contradict the command: a divider or its wire is broken
//   start                  the ramp ended without crossings to be trusted
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
  std::uint8_t window_eighths = 16;          ///< of a sector's time, from one crossing to the next
  std::uint8_t tolerated = 2;                ///< sectors in a row whose crossing was not seen
  std::uint8_t unlike_samples = 4;           ///< in a row that contradict the command
  std::uint32_t shortest_ticks = 0;          ///< of a sector: faster is no rotor
  std::uint32_t longest_ticks = 0xffffffff;  ///< of a sector: slower cannot be seen
  std::uint32_t most_flux = 0xffffffff;      ///< counts of y times ticks of T
  std::int32_t threshold = 0x7fffffff;       ///< counts of y that are a voltage and no noise
  std::uint8_t retries = 3;                  ///< losses and failed starts in a row before the drive gives up
  std::uint16_t sectors_to_forget = 60;      ///< that hold until the count of losses begins anew
  bool operator==(const LockConfig&) const = default;
};

struct LockState {
  std::uint8_t hidden = 0;  ///< sectors in a row that showed no crossing for the old current
  std::uint8_t early = 0;   ///< sectors in a row that had crossed before one could look
  std::uint8_t odd = 0;     ///< samples in a row that no rotor in this sector at this speed makes
  std::uint8_t jumps = 0;   ///< sectors in a row whose time was nothing like the one before
  std::uint8_t losses = 0;  ///< in a row
  std::uint16_t held = 0;   ///< sectors since the last loss
  LockLoss last = LockLoss::none;
};

/// The lock is looked after from now on.
constexpr void lock_begin(LockState& state) {
  state.hidden = 0;
  state.early = 0;
  state.jumps = 0;
  state.odd = 0;
  state.held = 0;
}

/// Whether a rotor may take that long after a sector of T ticks.
constexpr bool follows_on(std::uint32_t interval, std::uint32_t T) {
  return interval / 5 >= T / 8 && interval / 8 <= T / 5;
}

/// A sector's crossing was seen, or had passed. `interval`: ticks since the one before, where sectors take T; T = 0: that
/// one was not seen. `hidden`: the old current ran out meanwhile.
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

/// A sample of the back-EMF in a sector that has its crossing behind it, `crossed`, or still ahead.
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

/// No crossing yet, `since` ticks after the last one, where sectors take T. `hides`: the old current still runs.
constexpr LockLoss lock_waiting(const LockConfig& config, std::uint32_t since, std::uint32_t T, bool hides,
                                std::uint8_t unlike_samples) {
  if (unlike_samples >= config.unlike_samples) return LockLoss::terminals;
  const std::uint32_t eighth = T / 8, most = config.longest_ticks;
  const std::uint32_t window = eighth < most / config.window_eighths ? eighth * config.window_eighths : most;
  if (since <= window) return LockLoss::none;
  return hides ? LockLoss::long_demagnetisation : LockLoss::masked_crossing;
}

/// Counts a loss; true where the drive is to give up.
constexpr bool lock_lost(const LockConfig& config, LockState& state, LockLoss loss) {
  lock_begin(state);
  state.last = loss;
  if (state.losses < 255) ++state.losses;
  return state.losses > config.retries;
}

}  // namespace sixstep::control
