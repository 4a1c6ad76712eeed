// SPDX-License-Identifier: Apache-2.0
// Makes an ATmega2560's registers variables, and names the interrupts that the program serves.
#pragma once
#include "faces/firmware/example/avr/addresses.hpp"

namespace firmware {

inline volatile std::uint8_t& byte(atmega2560::Address address) {
  return *reinterpret_cast<volatile std::uint8_t*>(address);
}
/// `address` is the low byte's. The compiler writes the high byte first and reads it last, as 16-bit registers
/// need it.
inline volatile std::uint16_t& word(atmega2560::Address address) {
  return *reinterpret_cast<volatile std::uint16_t*>(address);
}

}  // namespace firmware

// Interrupts by their numbers, as the compiler requires them (14.1).
#define INTERRUPT_PCINT2 __vector_11
#define INTERRUPT_TIMER1_CAPT __vector_16
#define INTERRUPT_TIMER0_OVF __vector_23
#define INTERRUPT_ADC __vector_29
