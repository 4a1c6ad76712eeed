// SPDX-License-Identifier: Apache-2.0
// Finds the wirings that explain the codes at the pins in each sector.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "sixstep/rig/wiring.hpp"

namespace sixstep::analysis {

/// Probes behind the pins of a board, as in a scenario.
struct HallWires {
  bool spaced_60 = false;
  rig::WireOrder probes = rig::WireOrder::abc;  ///< probes at pins H1, H2, H3
  std::uint8_t inverted = 0;                    ///< inverted pins, as bits of a code

  bool operator==(const HallWires&) const = default;
  bool are_straight() const { return *this == HallWires{}; }
};

/// H1 H2 H3 as a code, in sectors 0 to 5.
using PinCodes = std::array<std::uint8_t, 6>;

PinCodes codes_behind(const HallWires& wires);

/// All wirings that show these codes, the simplest first: fewest inverted lines (three inverted lines count
/// as one, because one stage inverts them), then probes 120 degrees apart, then each line at its own pin. The
/// codes do not distinguish these wirings, and the table for a drive is the same. If 000 and 111 never occur,
/// the first wirings have probes 120 degrees apart and no inverted line or three. Each possible order of
/// codes of three lines has exactly one such wiring.
std::vector<HallWires> wires_behind(const PinCodes& codes);

}  // namespace sixstep::analysis
