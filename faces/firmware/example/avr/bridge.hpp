// SPDX-License-Identifier: Apache-2.0
// Converts a bridge command to output pins. Timer 1 always outputs its pulse to PB5..PB7 (OC1A..OC1C), and a
// bit of DDRB enables the upper gate of the source's leg. Lower gates are plain pins (PA0..PA2).
//
// The timer must not disconnect the output (COM1x = 0). When it connects the output again, the output has the
// level of its last match for the rest of the half period (data sheet 2549, 17.8.1).
#pragma once
#include <cstdint>

#include "sixstep/control/bridge_command.hpp"

namespace firmware {

struct Pins {
  std::uint8_t DDRB, PORTA;
};

constexpr Pins all_off{0, 0};

/// The pins for gates() of soft chopping by the upper switch. A compare register of 0 gives no pulse
/// (17.8.3), so at a duty of 0 the gates stay as in the off-time. The two gates of a leg are never both on.
template <class Scalar>
constexpr Pins pins(const sixstep::control::BridgeCommand<Scalar>& command) {
  constexpr std::uint8_t upper[3] = {1u << 5, 1u << 6, 1u << 7}, lower[3] = {1u << 0, 1u << 1, 1u << 2};
  if (!command.enabled || command.pair.source == command.pair.sink) return all_off;
  return {upper[static_cast<int>(command.pair.source)], lower[static_cast<int>(command.pair.sink)]};
}

}  // namespace firmware
