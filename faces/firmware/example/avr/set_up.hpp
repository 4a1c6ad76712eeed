// SPDX-License-Identifier: Apache-2.0
// What the registers hold before the first interrupt. All gates are inputs, pulled down outside, until a command lets one out.
#pragma once
#include "faces/firmware/example/avr/converter.hpp"

namespace firmware {

constexpr std::uint32_t baud = 1'000'000;

/// Of the watchdog's 16 ms; the two writes may be four cycles apart. True where it was the watchdog that brought the reset.
inline bool set_up_watchdog() {
  using namespace atmega2560;
  const bool bit_me = (byte(MCUSR) & WDRF) != 0;
  asm volatile("wdr");
  byte(MCUSR) = 0;
  byte(WDTCSR) = WDCE | WDE;
  byte(WDTCSR) = WDE;
  return bit_me;
}

inline void set_up_serial_line() {
  using namespace atmega2560;
  byte(UCSR0A) = U2X0;
  word(UBRR0L) = clock_Hz / 8 / baud - 1;
  byte(UCSR0C) = UCSZ01 | UCSZ00;
  byte(UCSR0B) = TXEN0;
}

/// Up and down (mode 10), pulses high around the bottom at PB5..PB7.
inline void set_up_timer() {
  using namespace atmega2560;
  word(ICR1L) = static_cast<std::uint16_t>(pwm_counts);
  byte(TCCR1A) = COM1A1 | COM1B1 | COM1C1 | WGM11;
  byte(TCCR1B) = WGM13 | CS10;
}

inline void set_up_hall_pins() {
  byte(atmega2560::PCMSK2) = 7;
  byte(atmega2560::PCICR) = atmega2560::PCIE2;
}

inline void set_up_converter() {
  byte(atmega2560::ADCSRB) = atmega2560::ADTS_timer1_overflow;
  look_at_channel(0);
  convert_at_bottom();
}

inline void set_up() {
  byte(atmega2560::DDRA) = 7;  // the lower gates, low
  set_up_serial_line();
  set_up_timer();
  set_up_hall_pins();
  set_up_converter();
  byte(atmega2560::SMCR) = atmega2560::SE;  // idle: timer, converter and serial line run on
}

}  // namespace firmware
