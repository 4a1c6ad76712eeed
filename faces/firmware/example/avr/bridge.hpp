// SPDX-License-Identifier: Apache-2.0
// A bridge command as output pins: the source's upper gate follows timer 1 (OC1A..OC1C), lower gates are
// plain pins (PA0..PA2). Without an on-time the off-time's gates stand all along, no upper one among them:
// never both of a leg.
#pragma once
#include <cstdint>

#include "sixstep/control/gates.hpp"

namespace firmware {

struct Pins {
  std::uint8_t TCCR1A;  ///< COM1A1, COM1B1, COM1C1 and WGM11 (phase correct up to ICR1)
  std::uint8_t PORTA;
};

constexpr Pins upper_gates_off{2, 0};

template <class Scalar>
constexpr Pins pins(const sixstep::control::BridgeCommand<Scalar>& command, bool has_on_time) {
  const unsigned g = gates(command, has_on_time);
  return {static_cast<std::uint8_t>((g & 1) << 7 | (g & 4) << 3 | (g & 16) >> 1 | upper_gates_off.TCCR1A),
          static_cast<std::uint8_t>((g & 2) >> 1 | (g & 8) >> 2 | (g & 32) >> 3)};
}

}  // namespace firmware
