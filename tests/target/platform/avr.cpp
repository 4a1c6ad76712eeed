// SPDX-License-Identifier: Apache-2.0
// ATmega2560: characters and the end by the general-purpose registers, which the board's program watches
// (avr_board.cpp). avr-libc's start code makes memory ready.
#include "tests/target/platform/platform.hpp"

namespace target {

volatile std::uint8_t& register_at(std::uint16_t address) {
  return *reinterpret_cast<volatile std::uint8_t*>(address);
}

void put(char c) { register_at(0x3E) = static_cast<std::uint8_t>(c); }  // GPIOR0
std::uint32_t steps_wanted() { return 10000; }

}  // namespace target

extern "C" int main() {
  target::run();
  target::register_at(0x4A) = 1;  // GPIOR1: done
  return 0;
}
