// SPDX-License-Identifier: Apache-2.0
// Decodes the Hall pins to sector and direction, with a filter against glitches. Two faults are detected: a
// code that the arrangement cannot give, and a jump over a sector. If the times allow it, the broken line is
// named. The table of codes is in commutation.hpp.
//
// Probes 60 degrees apart give 110 111 011 001 000 100 in sectors 0 to 5: each probe is high over half a turn
// and lags the probe before by one sector. 010 and 101 are invalid (model.md 3). H3 of this arrangement
// equals H2 of probes 120 degrees apart, and H2 of this arrangement equals their inverted H3.
#pragma once
#include <cstdint>

#include "sixstep/control/commutation.hpp"

namespace sixstep::control {

enum class HallArrangement : std::uint8_t { degrees_120, degrees_60 };

/// Class of the time since the last edge, compared with the sectors before (hall_speed.hpp). It is used only
/// to name a broken line.
enum class SectorTime : std::uint8_t {
  unknown,  ///< the rotor starts, slows down or has reversed, or no other class fits
  soon,     ///< less than 3/4 of a sector's time
  within,   ///< no longer than a sector's time
  twice     ///< about two sectors' time: an edge was missed
};

enum class HallFault : std::uint8_t {
  none,
  impossible_code,  ///< a code that intact probes do not give: a wire or a probe is broken
  jump              ///< step between two sectors that are not neighbours: an edge was missed, or noise
};

struct HallConfig {
  HallArrangement arrangement = HallArrangement::degrees_120;
  /// Consecutive equal samples after which a new code is accepted. n samples delay each edge by n - 1
  /// samples; 0 counts as 1. Keep 1 in an interrupt, which must accept the first reading.
  std::uint8_t stable_samples = 1;
  bool operator==(const HallConfig&) const = default;
};

struct HallState {
  std::uint8_t candidate = 0xff;      ///< the code under test
  std::uint8_t seen = 0;              ///< samples since the candidate appeared
  std::uint8_t sector = no_sector;    ///< the last valid sector
  std::int8_t direction = 0;          ///< direction of the last edge: +1 forward, -1 backward, 0 none yet
  std::uint8_t suspect = 0;           ///< 1..3: line with an edge that is impossible at steady speed; 0: none
  std::uint8_t edges_since = 0;       ///< edges since the suspect's edge; `suspect` is cleared after 6
  HallFault fault = HallFault::none;  ///< impossible_code while an invalid code is present
};

struct HallReading {
  std::uint8_t sector = no_sector;  ///< no_sector before the first code and during an invalid code
  std::int8_t moved = 0;            ///< sectors passed since the last call: -1, 0 or 1
  HallFault fault = HallFault::none;
  std::uint8_t line = 0;  ///< 1..3: the line that causes an invalid code; 0: unknown
};

/// Converts a code of the arrangement to the code of probes 120 degrees apart.
constexpr std::uint8_t as_120_degrees(HallArrangement arrangement, std::uint8_t code) {
  if (arrangement == HallArrangement::degrees_120) return code;
  if (code > 0b111) return code;
  const bool h1 = (code & 0b100) != 0, h2 = (code & 0b010) != 0, h3 = (code & 0b001) != 0;
  return static_cast<std::uint8_t>((h1 ? 0b100 : 0) | (h3 ? 0b010 : 0) | (h2 ? 0 : 0b001));
}

/// Number of sectors from `from` to `to` by the shorter rotation: -2..3.
constexpr std::int8_t sectors_between(std::uint8_t from, std::uint8_t to) {
  const std::int8_t ahead = static_cast<std::int8_t>((to + 6 - from) % 6);
  return static_cast<std::int8_t>(ahead > 3 ? ahead - 6 : ahead);
}

/// 1..3 if exactly one line differs between two codes, else 0.
constexpr std::uint8_t changed_line(std::uint8_t a, std::uint8_t b) {
  const unsigned bits = static_cast<unsigned>(a ^ b);
  return bits == 0b100   ? std::uint8_t{1}
         : bits == 0b010 ? std::uint8_t{2}
         : bits == 0b001 ? std::uint8_t{3}
                         : std::uint8_t{0};
}

namespace detail {

/// The line that causes an invalid code, for codes of probes 120 degrees apart; 0: unknown. Only the times of
/// a steadily running rotor distinguish the two cases:
/// - A line breaks between its edges. It is the line that changes now, or the line whose last edge was false.
/// - A line misses its edge. The code stays valid for two sectors, until the next line's edge. The rotor is
///   then two sectors further, and the broken line is the line that differs from the code due there.
constexpr std::uint8_t broken_line(const HallState& state, std::uint8_t code, SectorTime time) {
  const auto differs_from = [&](int sectors_on) {
    const int sector = (state.sector + 12 + sectors_on * state.direction) % 6;
    return changed_line(hall_of_sector(static_cast<std::uint8_t>(sector)), code);
  };
  if (time == SectorTime::unknown || state.direction == 0) return 0;
  if (time == SectorTime::twice) return differs_from(2);
  const std::uint8_t line = differs_from(0);
  return line != 0 ? line : differs_from(1);  // the line broke together with its neighbour's edge
}

/// Undoes the exchange of lines 2 and 3 that as_120_degrees() makes.
constexpr std::uint8_t line_of(HallArrangement arrangement, std::uint8_t line) {
  return arrangement == HallArrangement::degrees_60 && line > 1 ? static_cast<std::uint8_t>(5 - line) : line;
}

/// Processes one line's edge to a neighbouring sector. With a steadily running rotor no edge occurs within
/// 3/4 of a sector after the last edge, and the rotor does not reverse within a sector. Such an edge shows
/// that its line is broken.
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
