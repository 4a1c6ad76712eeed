// SPDX-License-Identifier: Apache-2.0
// The program on the ATmega2560 communicates by its three general-purpose registers, which the board's
// program monitors (avr_board.cpp). The start code of avr-libc initialises the memory. The addresses of the
// registers are from the data sheet.
#include "tests/target/platform/platform.hpp"

namespace target {

volatile std::uint8_t& register_at(std::uint16_t address) {
  return *reinterpret_cast<volatile std::uint8_t*>(address);
}
constexpr std::uint16_t GPIOR0 = 0x3E, GPIOR1 = 0x4A, GPIOR2 = 0x4B;
constexpr std::uint16_t DDRD = 0x2A, PORTD = 0x2B, EIMSK = 0x3D, EICRA = 0x69;

}  // namespace target

extern "C" {
/// The destination and the number of the next bytes. The board replaces the number by the number of bytes
/// that it has delivered.
struct {
  std::uint8_t* to;
  std::uint16_t bytes;
} volatile refill_request;
}

namespace target {

void put(char c) { register_at(GPIOR0) = static_cast<std::uint8_t>(c); }
std::uint32_t steps_wanted() { return 10000; }

std::uint16_t refill(const char*, std::uint8_t* to, std::uint16_t bytes) {
  refill_request.to = to;
  refill_request.bytes = bytes;
  asm volatile("" ::: "memory");
  register_at(GPIOR2) = 1;
  asm volatile("" ::: "memory");
  return refill_request.bytes;
}

/// If GPIOR1 is not zero, the entry is called as an interrupt, which a change of an output pin requests
/// (ATmega2560 data sheet, External Interrupts).
void call_entry(bool hall, void (*entry)()) {
  if (register_at(GPIOR1) == 0) return entry();
  const std::uint8_t pin = hall ? 2 : 1;
  register_at(PORTD) = register_at(PORTD) ^ pin;
  asm volatile("nop\n nop\n nop" ::: "memory");
}

}  // namespace target

extern "C" int main() {
  using namespace target;
  // Any change of a pin requests INT0 or INT1. This mode is set before the pins, because their low level
  // would otherwise request an interrupt at once.
  register_at(EICRA) = 5;
  register_at(DDRD) = 3;
  register_at(EIMSK) = 3;
  asm volatile("sei");
  run();
  register_at(GPIOR1) = 255;
  return 0;
}
