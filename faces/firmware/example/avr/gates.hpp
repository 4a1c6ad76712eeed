// SPDX-License-Identifier: Apache-2.0
// Changes the six gates. First turns gates off; after the dead time, turns others on. No gate turns on
// earlier than the dead time after any other gate has turned off, even if two changes follow each other. All
// functions here run with interrupts off.
#pragma once
#include "faces/firmware/example/avr/board.hpp"
#include "faces/firmware/example/avr/bridge.hpp"

namespace firmware {

/// The sign of the pair's voltage. The index in pins_by_way is this number plus the reading of the Hall pins.
enum class Way : std::uint8_t { off = 0, positive = 8, negative = 16 };

/// The result of on_hall() for each sign and each reading of the Hall pins, computed at compile time.
struct PinsByWay {
  Pins at[24];
};
constexpr PinsByWay pins_by_way = [] {
  PinsByWay all{};
  for (unsigned n = 0; n < 24; ++n) {
    const auto way = static_cast<Way>(n & ~7u);
    DriveState<Scalar> state;
    state.reversed = way == Way::negative;
    state.command.enabled = way != Way::off;
    all.at[n] = pins(on_hall(drive, state, by_pins.code[n & 7]));
  }
  return all;
}();

inline Way shown = Way::off;   // sign for which the gates are set now
inline Way wanted = Way::off;  // sign from the next TOP on; at TOP the timer also loads the on-time

/// Turns a lower gate off and an upper gate on. From turning the lower gate off to enabling the upper gate,
/// it takes exactly dead_cycles. Turning an upper gate off and a lower gate on takes two cycles more.
inline void change_over(Pins stay, Pins to) {
  constexpr std::uint8_t loops = (dead_cycles - 1) / 3, rest = (dead_cycles - 1) % 3;
  static_assert(loops > 0 && (dead_cycles - 1) / 3 < 256, "one byte counts it");
  std::uint8_t count;
  asm volatile(
      "out %[DDRB], %[stay_b]\n\t"
      "out %[PORTA], %[stay_a]\n\t"
      "ldi %[count], %[loops]\n"
      "1:\tdec %[count]\n\t"
      "brne 1b\n\t"
      ".rept %[rest]\n\t"
      "nop\n\t"
      ".endr\n\t"
      "out %[DDRB], %[to_b]\n\t"
      "out %[PORTA], %[to_a]"
      : [count] "=&d"(count)
      : [DDRB] "I"(atmega2560::DDRB - 0x20), [PORTA] "I"(atmega2560::PORTA - 0x20), [stay_b] "r"(stay.DDRB),
        [stay_a] "r"(stay.PORTA), [to_b] "r"(to.DDRB), [to_a] "r"(to.PORTA), [loops] "M"(loops),
        [rest] "M"(rest)
      : "memory");
}

/// Sets the gates for the sign `shown` and these Hall pins. A gate that stays on is not written, because its
/// pulse may be in progress.
inline void show(std::uint8_t hall) {
  const Pins to = pins_by_way.at[static_cast<std::uint8_t>(shown) | hall];
  volatile std::uint8_t &uppers = byte(atmega2560::DDRB), &lowers = byte(atmega2560::PORTA);
  const Pins stay{static_cast<std::uint8_t>(uppers & to.DDRB), static_cast<std::uint8_t>(lowers & to.PORTA)};
  if (stay.DDRB == to.DDRB && stay.PORTA == to.PORTA) {
    uppers = to.DDRB;
    lowers = to.PORTA;
  } else {
    change_over(stay, to);
  }
}

inline void turn_off() {
  byte(atmega2560::DDRB) = 0;
  byte(atmega2560::PORTA) = 0;
  shown = wanted = Way::off;
}

}  // namespace firmware
