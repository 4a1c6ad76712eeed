// SPDX-License-Identifier: Apache-2.0
// Hall decoding: pins -> sector and direction, with the two codes that an arrangement cannot give and jumps
// over a sector as faults, the broken line by name where it can be told, and a filter against glitches. The
// table itself is commutation.hpp's.
//
// Probes 60 degrees apart give 110 111 011 001 000 100 in sectors 0 to 5 (each probe is high over half a turn
// and lags its predecessor by one sector); 010 and 101 are impossible (model.md 3). Their H3 is the H2 of
// probes 120 degrees apart, their H2 the complement of that arrangement's H3.
#pragma once
#include <cstdint>

#include "sixstep/control/commutation.hpp"

namespace sixstep::control {

enum class HallArrangement : std::uint8_t { degrees_120, degrees_60 };

/// How long the present sector lasts, by the times of the edges before (hall_speed.hpp). It only helps to
/// name a broken line.
enum class SectorTime : std::uint8_t {
  unknown,  ///< the rotor starts, slows down or turned back, or it is none of the others
  soon,     ///< less than 3/4 of a sector
  within,   ///< no longer than a sector
  twice     ///< as long as two: an edge was missed
};

enum class HallFault : std::uint8_t {
  none,
  impossible_code,  ///< a broken wire or probe
  jump              ///< from one sector to another that is no neighbour: an edge was missed, or noise
};

struct HallConfig {
  HallArrangement arrangement = HallArrangement::degrees_120;
  /// A new code counts when it stood this many samples in a row. It delays each edge by so many samples less
  /// one; 0 counts as 1. In an interrupt, where the first reading counts, leave it at 1.
  std::uint8_t stable_samples = 1;
  bool operator==(const HallConfig&) const = default;
};

struct HallState {
  std::uint8_t candidate = 0xff;      ///< a code on trial
  std::uint8_t seen = 0;              ///< samples it has stood
  std::uint8_t sector = no_sector;    ///< the last good one
  std::int8_t direction = 0;          ///< of the last edge: +1 forward, -1 backward, 0 before the first
  std::uint8_t suspect = 0;           ///< 1..3: its edge came sooner than a steady rotor brings or turns it
  std::uint8_t edges_since = 0;       ///< that edge: after a turn it is cleared of suspicion
  HallFault fault = HallFault::none;  ///< an impossible code stands
};

struct HallReading {
  std::uint8_t sector = no_sector;  ///< no_sector before the first code and while an impossible one stands
  std::int8_t moved = 0;            ///< sectors passed since the last call: -1, 0 or 1
  HallFault fault = HallFault::none;
  std::uint8_t line = 0;  ///< 1..3: the line that is to blame for an impossible code; 0: cannot be told
};

/// The code that probes 120 degrees apart would give.
constexpr std::uint8_t as_120_degrees(HallArrangement arrangement, std::uint8_t code) {
  if (arrangement == HallArrangement::degrees_120) return code;
  if (code > 0b111) return code;
  const bool h1 = (code & 0b100) != 0, h2 = (code & 0b010) != 0, h3 = (code & 0b001) != 0;
  return static_cast<std::uint8_t>((h1 ? 0b100 : 0) | (h3 ? 0b010 : 0) | (h2 ? 0 : 0b001));
}

/// Sectors from one to the other by the shorter way: -2..3.
constexpr std::int8_t sectors_between(std::uint8_t from, std::uint8_t to) {
  const std::int8_t ahead = static_cast<std::int8_t>((to + 6 - from) % 6);
  return static_cast<std::int8_t>(ahead > 3 ? ahead - 6 : ahead);
}

/// 1..3 where exactly one line differs between two codes, else 0.
constexpr std::uint8_t changed_line(std::uint8_t a, std::uint8_t b) {
  const unsigned bits = static_cast<unsigned>(a ^ b);
  return bits == 0b100   ? std::uint8_t{1}
         : bits == 0b010 ? std::uint8_t{2}
         : bits == 0b001 ? std::uint8_t{3}
                         : std::uint8_t{0};
}

namespace detail {

/// Which line makes an impossible code, in codes of probes 120 degrees apart; 0: it cannot be told. A line
/// that breaks while its level is due to stay is the one that changes now, or its edge was a false one. One
/// that misses its edge is silent for two sectors until its neighbour's edge makes the code impossible: the
/// rotor then is two sectors on, and the line is the one that differs from the code due there. Only times
/// tell these apart, and only those of a rotor that runs on steadily.
constexpr std::uint8_t broken_line(const HallState& state, std::uint8_t code, SectorTime time) {
  const auto differs_from = [&](int sectors_on) {
    const int sector = (state.sector + 12 + sectors_on * state.direction) % 6;
    return changed_line(hall_of_sector(static_cast<std::uint8_t>(sector)), code);
  };
  if (time == SectorTime::unknown || state.direction == 0) return 0;
  if (time == SectorTime::twice) return differs_from(2);
  const std::uint8_t line = differs_from(0);
  return line != 0 ? line : differs_from(1);  // it broke together with its neighbour's edge
}

/// Lines 2 and 3 have changed places in as_120_degrees.
constexpr std::uint8_t line_of(HallArrangement arrangement, std::uint8_t line) {
  return arrangement == HallArrangement::degrees_60 && line > 1 ? static_cast<std::uint8_t>(5 - line) : line;
}

/// To the next sector or the one before, by one line's edge. A rotor that runs on steadily brings no edge in
/// less than 3/4 of a sector, and turns in none: the line broke.
constexpr void take_edge(const HallConfig& config, HallState& state, std::uint8_t code, std::int8_t passed,
                         SectorTime time) {
  const bool turned = state.direction == -passed;
  if (state.edges_since < 6) ++state.edges_since;
  if (state.edges_since == 6 || turned) state.suspect = 0;
  if (time == SectorTime::soon || (turned && time == SectorTime::within)) {
    state.suspect = line_of(config.arrangement, changed_line(hall_of_sector(state.sector), code));
    state.edges_since = 0;
  }
  state.direction = passed;
}

constexpr HallReading accept_hall(const HallConfig& config, HallState& state, std::uint8_t code,
                                  SectorTime time) {
  const std::uint8_t sector = sector_of_hall(code);
  HallReading reading{sector, 0, HallFault::none, 0};
  if (sector == no_sector) {
    reading.fault = HallFault::impossible_code;
    if (state.sector != no_sector)
      reading.line =
          state.suspect != 0 ? state.suspect : line_of(config.arrangement, broken_line(state, code, time));
    state.direction = 0;
  } else if (state.sector != no_sector && sector != state.sector) {
    const std::int8_t passed = sectors_between(state.sector, sector);
    if (passed == 1 || passed == -1) {
      reading.moved = passed;
      take_edge(config, state, code, passed, time);
    } else {
      reading.fault = HallFault::jump;
    }
  }
  state.sector = sector;
  state.fault = sector == no_sector ? HallFault::impossible_code : HallFault::none;
  return reading;
}

}  // namespace detail

/// One reading of the three pins (H1 H2 H3 as bits 2, 1, 0).
constexpr HallReading hall_step(const HallConfig& config, HallState& state, std::uint8_t pins,
                                SectorTime time = SectorTime::unknown) {
  if (pins != state.candidate) {
    state.candidate = pins;
    state.seen = 0;
  }
  if (state.seen < 255) ++state.seen;
  if (state.seen < config.stable_samples) return {state.sector, 0, state.fault, 0};
  return detail::accept_hall(config, state, as_120_degrees(config.arrangement, pins), time);
}

}  // namespace sixstep::control
