// SPDX-License-Identifier: Apache-2.0
// An ATmega2560's registers as variables, and the interrupts that the program serves.
#pragma once
#include "faces/firmware/example/avr/addresses.hpp"

namespace firmware {

inline volatile std::uint8_t& byte(atmega2560::Address address) {
  return *reinterpret_cast<volatile std::uint8_t*>(address);
}
/// The low byte's address; the compiler writes the high byte first and reads it last, as 16-bit registers want it.
inline volatile std::uint16_t& word(atmega2560::Address address) {
  return *reinterpret_cast<volatile std::uint16_t*>(address);
}

}  // namespace firmware

// By their numbers, as the compiler wants them (14.1).
#define INTERRUPT_PCINT2 __vector_11
#define INTERRUPT_TIMER1_CAPT __vector_16
#define INTERRUPT_TIMER0_OVF __vector_23
#define INTERRUPT_ADC __vector_29
