// SPDX-License-Identifier: Apache-2.0
// A bridge command as output pins: timer 1 has its pulse ready on PB5..PB7 (OC1A..OC1C) all along, and the source's upper gate is let
// out by its bit of DDRB; lower gates are plain pins (PA0..PA2). An output that is disconnected in the timer (COM1x = 0) instead would
// come back as it left: with the level of its last match, for the rest of a half period (data sheet 2549, 17.8.1).
#pragma once
#include <cstdint>

#include "sixstep/control/bridge_command.hpp"

namespace firmware {

struct Pins {
  std::uint8_t DDRB, PORTA;
};

constexpr Pins all_off{0, 0};

/// As gates() of soft chopping by the upper switch has it, looked up. A compare register of 0 has no pulse (17.8.3), so that at a duty
/// of 0 the off-time's gates stand all along. Never both of a leg.
template <class Scalar>
constexpr Pins pins(const sixstep::control::BridgeCommand<Scalar>& command) {
  constexpr std::uint8_t upper[3] = {1u << 5, 1u << 6, 1u << 7}, lower[3] = {1u << 0, 1u << 1, 1u << 2};
  if (!command.enabled || command.pair.source == command.pair.sink) return all_off;
  return {upper[static_cast<int>(command.pair.source)], lower[static_cast<int>(command.pair.sink)]};
}

}  // namespace firmware
