// SPDX-License-Identifier: Apache-2.0
// Decodes the Hall pins to sector and direction, with a filter against glitches. Two faults are detected: a
// code that the arrangement cannot produce, and a jump over a sector. If the edge times allow it, the broken
// line is identified. The table of codes is in commutation.hpp.
//
// The codes of probes 60 degrees apart are 110 111 011 001 000 100 in sectors 0 to 5: each probe is high over
// half a turn and lags the previous probe by one sector. 010 and 101 are invalid (model.md 3). H3 of this
// arrangement equals H2 of the 120-degree arrangement. H2 of this arrangement equals the inverted H3 of the
// 120-degree arrangement.
#pragma once
#include <cstdint>

#include "sixstep/control/commutation.hpp"

namespace sixstep::control {

enum class HallArrangement : std::uint8_t { degrees_120, degrees_60 };

/// Class of the time since the last edge, relative to the times of the previous sectors (hall_speed.hpp). It
/// is used only to identify a broken line.
enum class SectorTime : std::uint8_t {
  unknown,  ///< the rotor starts, slows down or has reversed, or no other class fits
  soon,     ///< the time is less than 3/4 of a sector's time
  within,   ///< the time is 3/4 to 5/4 of a sector's time
  twice     ///< the time is about that of two sectors: an edge was missed
};

enum class HallFault : std::uint8_t {
  none,
  impossible_code,  ///< a code that intact probes cannot produce: a wire or a probe is broken
  jump              ///< change between two sectors that are not neighbours: an edge was missed, or the
                    ///< reading is disturbed
};

struct HallConfig {
  HallArrangement arrangement = HallArrangement::degrees_120;
  /// Consecutive equal samples after which a new code is accepted. n samples delay each edge by n - 1
  /// samples; 0 counts as 1. Keep 1 in an interrupt, which must accept the first reading.
  std::uint8_t stable_samples = 1;
  bool operator==(const HallConfig&) const = default;
};

struct HallState {
  std::uint8_t candidate = 0xff;      ///< the new code that is not accepted yet
  std::uint8_t seen = 0;              ///< number of consecutive samples with the candidate
  std::uint8_t sector = no_sector;    ///< the last valid sector
  std::int8_t direction = 0;          ///< direction of the last edge: +1 forward, -1 backward, 0 none yet
  std::uint8_t suspect = 0;           ///< 1..3: line with an edge that is impossible at steady speed; 0: none
  std::uint8_t edges_since = 0;       ///< number of edges since the edge that set `suspect`; the sixth edge
                                      ///< clears `suspect`
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

/// The line that causes an invalid code, for codes of probes 120 degrees apart; 0: unknown. There are two
/// cases. Only the edge times of a rotor at steady speed distinguish them:
/// - A line breaks between its edges. The broken line is the line that changes now, or the line whose last
///   edge was false.
/// - A line misses its edge. The code is valid for two sectors, until the edge of another line. The rotor is
///   then two sectors further. The broken line is the line that differs from the correct code of this sector.
constexpr std::uint8_t broken_line(const HallState& state, std::uint8_t code, SectorTime time) {
  const auto differs_from = [&](int sectors_on) {
    const int sector = (state.sector + 12 + sectors_on * state.direction) % 6;
    return changed_line(hall_of_sector(static_cast<std::uint8_t>(sector)), code);
  };
  if (time == SectorTime::unknown || state.direction == 0) return 0;
  if (time == SectorTime::twice) return differs_from(2);
  const std::uint8_t line = differs_from(0);
  return line != 0 ? line : differs_from(1);  // the line broke at the same time as another line's edge
}

/// Reverses the exchange of lines 2 and 3 by as_120_degrees().
constexpr std::uint8_t line_of(HallArrangement arrangement, std::uint8_t line) {
  return arrangement == HallArrangement::degrees_60 && line > 1 ? static_cast<std::uint8_t>(5 - line) : line;
}

/// Processes one line's edge to a neighbouring sector. At steady speed the next edge occurs later than 3/4 of
/// a sector's time, and the rotor does not reverse within a sector's time. Any other edge shows that its line
/// is broken.
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
