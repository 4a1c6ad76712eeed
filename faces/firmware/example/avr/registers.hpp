// SPDX-License-Identifier: Apache-2.0
// The registers of an ATmega2560 that the example touches, by their data-memory addresses. Source: Atmel
// datasheet 2549, register summary (33) and interrupt vectors (14.1).
#pragma once
#include <cstdint>

namespace firmware {

template <class Word>
inline volatile Word& at(std::uint16_t address) {
  return *reinterpret_cast<volatile Word*>(address);
}

inline volatile std::uint8_t& PORTA() { return at<std::uint8_t>(0x22); }
inline volatile std::uint8_t& DDRB() { return at<std::uint8_t>(0x24); }
inline volatile std::uint16_t& ADC() { return at<std::uint16_t>(0x78); }
inline volatile std::uint8_t& TIFR1() { return at<std::uint8_t>(0x36); }
inline volatile std::uint16_t& OCR1A() { return at<std::uint16_t>(0x88); }
inline volatile std::uint16_t& OCR1B() { return at<std::uint16_t>(0x8A); }
inline volatile std::uint16_t& OCR1C() { return at<std::uint16_t>(0x8C); }
inline volatile std::uint8_t& PINK() { return at<std::uint8_t>(0x106); }

constexpr std::uint8_t timer1_overflow = 1u << 0;  // TIFR1: TOV1; cleared by writing 1

}  // namespace firmware

// Interrupt numbers as the compiler wants them.
#define INTERRUPT_PCINT2 __vector_11
#define INTERRUPT_ADC __vector_29
