// SPDX-License-Identifier: Apache-2.0
// Declares an ATmega2560's registers as variables, and names the interrupts that the program handles.
#pragma once
#include "faces/firmware/example/avr/addresses.hpp"

namespace firmware {

inline volatile std::uint8_t& byte(atmega2560::Address address) {
  return *reinterpret_cast<volatile std::uint8_t*>(address);
}
/// A 16-bit register; `address` is the address of the low byte. The compiler writes the high byte first and
/// reads it last, as these registers require.
inline volatile std::uint16_t& word(atmega2560::Address address) {
  return *reinterpret_cast<volatile std::uint16_t*>(address);
}

}  // namespace firmware

// Names of interrupt functions with their numbers, in the form that the compiler requires (14.1).
#define INTERRUPT_PCINT2 __vector_11
#define INTERRUPT_TIMER1_CAPT __vector_16
#define INTERRUPT_TIMER0_OVF __vector_23
#define INTERRUPT_ADC __vector_29
