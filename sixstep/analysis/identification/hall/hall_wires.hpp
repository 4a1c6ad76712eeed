// SPDX-License-Identifier: Apache-2.0
// From what the pins show in each sector to the wires that make it so.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "sixstep/rig/wiring.hpp"

namespace sixstep::analysis {

/// Probes behind the pins of a board, as a scenario says it.
struct HallWires {
  bool spaced_60 = false;
  rig::WireOrder probes = rig::WireOrder::abc;  ///< at pins H1, H2, H3
  std::uint8_t inverted = 0;                    ///< pins, as bits of a code

  bool operator==(const HallWires&) const = default;
  bool are_straight() const { return *this == HallWires{}; }
};

/// H1 H2 H3 in sectors 0 to 5.
using PinCodes = std::array<std::uint8_t, 6>;

PinCodes codes_behind(const HallWires& wires);

/// All wires that show these codes; the plainest first: fewest inverted lines, where all three count as one, for one
/// stage does that; probes 120 degrees apart; each at its own pin. Where 000 and 111 never occur these are probes 120
/// degrees apart, none or all inverted. Codes alone cannot tell them apart, and the table for a drive is the same. Probes 120
/// degrees apart make every order of codes that three lines can show, in one way.
std::vector<HallWires> wires_behind(const PinCodes& codes);

}  // namespace sixstep::analysis
