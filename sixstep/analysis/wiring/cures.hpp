// SPDX-License-Identifier: Apache-2.0
// Finds how to correct a wrongly connected motor. A "cure" is the correction that moves the fewest wires.
// Also finds the next step for a person who observes the motor's motion but has no wiring plan.
#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "sixstep/analysis/wiring/wiring_theory.hpp"

namespace sixstep::analysis {

/// New terminal of the wire at each of three terminals; {0, 1, 2} moves no wire.
using Moves = std::array<std::size_t, 3>;
inline constexpr Moves stay = {0, 1, 2};

constexpr int moved(const Moves& moves) {
  return static_cast<int>(moves[0] != 0) + static_cast<int>(moves[1] != 1) + static_cast<int>(moves[2] != 2);
}

/// Moves of phase wires among the legs a, b, c and of Hall wires among the pins H1, H2, H3.
struct Cure {
  Moves legs = stay, pins = stay;
  int wires() const { return moved(legs) + moved(pins); }
  bool operator==(const Cure&) const = default;
};

rig::Wiring cured(const rig::Wiring& wiring, const Cure& cure);

/// All cures with the fewest wires after which the motor runs forward with its whole torque. Cures that move
/// only phases come first, then cures that move only Hall lines. The three correct wirings have one cure,
/// which moves no wire. Moving only phases cannot cure two swapped probes: the best result is then a motor
/// that runs well backward.
std::vector<Cure> shortest_cures(const rig::Wiring& wiring);

/// Next step, for the observed behaviour of the motor. After at most four steps it runs well forward.
/// - The motor hums: swap two phases. Then the motor runs.
/// - It runs early or late: shift all three phases cyclically. After one or two shifts it runs well in the
///   opposite direction.
/// - It runs well backward: swap phases a and b, and Hall lines 2 and 3. Then it runs forward.
Cure next_step(WiringDoes does);

}  // namespace sixstep::analysis
