// SPDX-License-Identifier: Apache-2.0
// Finds the motion of the rotor while the bridge is off. The signs of the three back-EMFs (terminal voltages
// minus their mean) form six patterns. The patterns follow each other like the codes of Hall probes. The
// pattern changes at the zero crossings. Forward, the pattern of sector n begins in the middle of sector n.
// Backward, every back-EMF has the opposite sign, and the change back to pattern m is in the middle of sector
// m + 4.
//
//   3 e_k = 3 u_k - (u_a + u_b + u_c)      without current; needs no connection to the star point
//
// The order of the patterns shows the direction, and their times show the speed (commutation_clock.hpp). With
// both values the drive can continue from the speed of a turning rotor without stopping it.
#pragma once
#include <cstdint>

#include "sixstep/control/sensorless/commutation_clock.hpp"
#include "sixstep/control/sensorless/zero_crossing.hpp"

namespace sixstep::control {

struct SpinConfig {
  std::int32_t threshold = 0x7fffffff;  ///< counts of |3 e_k| above which the value counts as a voltage, not
                                        ///< as noise
  std::uint8_t crossings = 4;           ///< number of consecutive crossings at similar intervals in one
                                        ///< direction after which the rotor counts as turning
  std::uint32_t settle_ticks = 0;       ///< time from turning the bridge off until the currents have ended
  /// Time without a crossing after which the rotor counts as at rest; 0: the motion is not measured.
  std::uint32_t listen_ticks = 0;
  bool operator==(const SpinConfig&) const = default;
};

struct SpinState {
  std::int32_t e[3]{};      ///< 3 e_k of the last sample, counts
  std::uint32_t zero[3]{};  ///< time of the last change of each sign
  std::uint32_t at = 0;     ///< time of the last sample
  std::uint32_t since = 0;  ///< time of the last crossing, or of the begin
  std::uint8_t signs = 0;   ///< signs as bits 2, 1, 0: positive back-EMF of a, b, c; 000: not determined yet
  std::uint8_t found = 0;   ///< number of consecutive crossings at similar intervals
  bool looked = false;
};

struct SpinReading {
  bool crossed = false;
  std::int8_t direction = 0;
  std::uint8_t sector = no_sector;  ///< sector in whose middle the crossing is
  std::uint32_t at = 0;
};

constexpr void spin_begin(SpinState& state, std::uint32_t now) {
  state = SpinState{};
  state.since = now;
}

namespace detail {

/// Updates the signs. A sign changes when the voltage exceeds the threshold. The time of the change is the
/// zero of the straight line through two samples.
constexpr std::uint8_t spin_signs(const SpinConfig& config, SpinState& state, const TerminalSample& s) {
  std::uint8_t signs = state.signs;
  for (std::uint8_t k = 0; k < 3; ++k) {
    const std::int32_t e = above_neutral(s, k), before = state.e[k];
    if (!state.looked)
      state.zero[k] = s.at;  // the time of a crossing before the first sample is unknown; the time of this
                             // sample is used
    if (state.looked && before < 0 && e >= 0) state.zero[k] = crossed_at(state.at, -before, s.at, -e);
    if (state.looked && before >= 0 && e < 0)
      state.zero[k] = before == 0 ? state.at : crossed_at(state.at, before, s.at, e);
    const std::uint8_t bit = static_cast<std::uint8_t>(4 >> k);
    if (e > config.threshold) signs = static_cast<std::uint8_t>(signs | bit);
    if (e < -config.threshold) signs = static_cast<std::uint8_t>(signs & ~bit);
    state.e[k] = e;
  }
  state.at = s.at;
  state.looked = true;
  return signs;
}

}  // namespace detail

/// Processes one sample with the bridge off and without currents. Writes the crossings' times to `clock`.
constexpr SpinReading spin_step(const SpinConfig& config, SpinState& state, CommutationClockState& clock,
                                const TerminalSample& s) {
  const std::uint8_t before = sector_of_hall(state.signs);
  state.signs = detail::spin_signs(config, state, s);
  const std::uint8_t now = sector_of_hall(state.signs);
  if (now == no_sector || now == before) return {};
  const std::uint8_t changed =
      before == no_sector ? std::uint8_t{0} : changed_line(hall_of_sector(before), hall_of_sector(now));
  if (changed == 0) {
    state.found = 0;
    clock.crossings = HallSpeedState{};
    return {};
  }
  SpinReading reading{true, sectors_between(before, now), now, state.zero[changed - 1]};
  if (reading.direction < 0) reading.sector = static_cast<std::uint8_t>((now + 4) % 6);
  const bool turned = reading.direction != clock.crossings.direction;
  const std::uint32_t earlier = last_interval(clock);
  commutation_clock_crossing(clock, reading.at, reading.direction);
  const std::uint32_t later = last_interval(clock);
  const bool like = !turned && (earlier == 0 || (later < 2 * earlier && earlier < 2 * later));
  state.found = like ? static_cast<std::uint8_t>(state.found + 1) : std::uint8_t{1};
  state.since = s.at;
  return reading;
}

/// True after config.crossings crossings, at least two, at similar intervals: the drive may then continue
/// from the present speed.
constexpr bool spin_found(const SpinConfig& config, const SpinState& state) {
  return state.found >= config.crossings && state.found >= 2;
}

}  // namespace sixstep::control
