// SPDX-License-Identifier: Apache-2.0
// What the rotor does while the bridge is off: the signs of the three back-EMFs, terminals against their mean, make six
// patterns, which follow each other as the codes of Hall probes do. Their changes are the zero crossings. Forward the
// pattern of sector n begins in the middle of sector n; backward every back-EMF has its other sign, and the pattern that
// goes back to m ends in the middle of sector m + 4.
//
//   3 e_k = 3 u_k - (u_a + u_b + u_c)      with no current: a star point of its own is not needed
//
// The order of the patterns gives the direction, their times the speed (commutation_clock.hpp): enough to take a spinning
// rotor over without stopping it.
#pragma once
#include <cstdint>

#include "sixstep/control/sensorless/commutation_clock.hpp"
#include "sixstep/control/sensorless/zero_crossing.hpp"

namespace sixstep::control {

struct SpinConfig {
  std::int32_t threshold = 0x7fffffff;  ///< counts of 3 e_k that are a voltage and no noise
  std::uint8_t crossings = 4;           ///< in one direction, at like distances, that are a spinning rotor
  std::uint32_t settle_ticks = 0;       ///< after the bridge went off: the currents' end
  std::uint32_t listen_ticks =
      0;  ///< without a crossing for so long the rotor stands; 0: do not listen at all
  bool operator==(const SpinConfig&) const = default;
};

struct SpinState {
  std::int32_t e[3]{};      ///< of the last sample
  std::uint32_t zero[3]{};  ///< when each changed its sign last
  std::uint32_t at = 0;     ///< the last sample
  std::uint32_t since = 0;  ///< nothing has happened
  std::uint8_t signs = 0;   ///< positive ones as bits 2, 1, 0 of a, b, c; 000 not known yet
  std::uint8_t found = 0;   ///< crossings at like distances
  bool looked = false;
};

struct SpinReading {
  bool crossed = false;
  std::int8_t direction = 0;
  std::uint8_t sector = no_sector;  ///< in whose middle the crossing lies
  std::uint32_t at = 0;
};

constexpr void spin_begin(SpinState& state, std::uint32_t now) {
  state = SpinState{};
  state.since = now;
}

namespace detail {

/// A sign counts once the voltage is beyond the threshold; its zero lay where the line to it crossed nothing.
constexpr std::uint8_t spin_signs(const SpinConfig& config, SpinState& state, const TerminalSample& s) {
  std::uint8_t signs = state.signs;
  for (std::uint8_t k = 0; k < 3; ++k) {
    const std::int32_t e = above_neutral(s, k), before = state.e[k];
    if (!state.looked) state.zero[k] = s.at;  // of one that had just passed: about now
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

/// One sample with the bridge off and the currents gone. The crossings' times go to `clock`.
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

/// So many crossings that the rotor can be taken over.
constexpr bool spin_found(const SpinConfig& config, const SpinState& state) {
  return state.found >= config.crossings && state.found >= 2;
}

}  // namespace sixstep::control
