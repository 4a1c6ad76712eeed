// SPDX-License-Identifier: Apache-2.0
// How a motor that is plugged in wrongly is put right: the fewest wires to move, and what to do step by step for somebody who
// sees what the motor does but not which wire is which.
#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "sixstep/analysis/wiring/wiring_theory.hpp"

namespace sixstep::analysis {

/// The wire at each of three places goes to this one; at its own it stays.
using Moves = std::array<std::size_t, 3>;
inline constexpr Moves stay = {0, 1, 2};

constexpr int moved(const Moves& moves) {
  return static_cast<int>(moves[0] != 0) + static_cast<int>(moves[1] != 1) + static_cast<int>(moves[2] != 2);
}

/// Phase wires among the legs a, b, c and Hall wires among the pins H1, H2, H3.
struct Cure {
  Moves legs = stay, pins = stay;
  int wires() const { return moved(legs) + moved(pins); }
  bool operator==(const Cure&) const = default;
};

rig::Wiring cured(const rig::Wiring& wiring, const Cure& cure);

/// All cures of the fewest wires that make it run forward with its whole torque; those that move phases alone come first, then
/// Hall lines alone. One that moves nothing for the three wirings that need none.
/// Phases alone cannot do it where two probes have changed places: then the motor runs well backward at best.
std::vector<Cure> shortest_cures(const rig::Wiring& wiring);

/// What to do next, by what the motor does, so that after four steps at most it runs forward well:
///   hums                       two phases swapped: it runs
///   runs early or late         all three phases moved on: after one or two times it runs well, the other way round
///   runs backward well         phases a and b swapped, and Hall lines 2 and 3: it runs forward
Cure next_step(WiringDoes does);

}  // namespace sixstep::analysis
