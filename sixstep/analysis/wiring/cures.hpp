// SPDX-License-Identifier: Apache-2.0
// Finds how to correct a wrongly connected motor: the cure that moves the fewest wires, and the next step for
// a person who can observe the motor's motion but not the wires' order.
#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "sixstep/analysis/wiring/wiring_theory.hpp"

namespace sixstep::analysis {

/// New place of the wire at each of three places; {0, 1, 2} moves no wire.
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

/// All cures with the fewest wires that make the motor run forward with its whole torque. Cures that move
/// phases alone come first, then those that move Hall lines alone. The three correct wirings have one cure,
/// which moves no wire. Phases alone cannot cure two swapped probes: the best result is then a motor that
/// runs well backward.
std::vector<Cure> shortest_cures(const rig::Wiring& wiring);

/// Next step, by what the motor does. After at most four steps it runs well forward.
/// - The motor hums: swap two phases. It then runs.
/// - It runs early or late: shift all three phases cyclically. After one or two times it runs well in the
///   opposite direction.
/// - It runs well backward: swap phases a and b, and Hall lines 2 and 3. It then runs forward.
Cure next_step(WiringDoes does);

}  // namespace sixstep::analysis
