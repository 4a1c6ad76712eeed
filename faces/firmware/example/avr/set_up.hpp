// SPDX-License-Identifier: Apache-2.0
// Sets the registers before the first interrupt. All gate pins are inputs with external pull-downs until a
// command enables a gate.
#pragma once
#include "faces/firmware/example/avr/converter.hpp"
#include "faces/firmware/example/avr/standing.hpp"

namespace firmware {

constexpr std::uint32_t baud = 1'000'000;

/// Sets the watchdog to 16 ms. The two writes of WDTCSR must be within four cycles. Returns the cause of the
/// reset (MCUSR).
inline std::uint8_t set_up_watchdog() {
  using namespace atmega2560;
  const std::uint8_t cause = byte(MCUSR);
  asm volatile("wdr");
  byte(MCUSR) = 0;
  byte(WDTCSR) = WDCE | WDE;
  byte(WDTCSR) = WDE;
  return cause;
}

inline void set_up_serial_line() {
  using namespace atmega2560;
  byte(UCSR0A) = U2X0;
  word(UBRR0L) = clock_Hz / 8 / baud - 1;
  byte(UCSR0C) = UCSZ01 | UCSZ00;
  byte(UCSR0B) = TXEN0;
}

/// The timer counts up and down (mode 10). PB5..PB7 have high pulses around BOTTOM.
inline void set_up_timer() {
  using namespace atmega2560;
  word(ICR1L) = static_cast<std::uint16_t>(pwm_counts);
  byte(TCCR1A) = COM1A1 | COM1B1 | COM1C1 | WGM11;
  byte(TCCR1B) = WGM13 | CS10;
}

/// Timer 0 overflows if no control interrupt resets it for half a millisecond. If the PWM period is above 0.2
/// ms, it overflows after two and a half periods.
constexpr bool is_long_period = exported::pwm_period_ps > 200'000'000;
constexpr std::uint64_t patience_ps = is_long_period ? exported::pwm_period_ps / 2 * 5 : 500'000'000;
constexpr std::uint64_t patience_counts = patience_ps / (is_long_period ? 64'000'000 : 4'000'000);
static_assert(patience_counts > 1 && patience_counts < 256, "timer 0 has 8 bits");

inline void control_interrupt_came() {
  byte(atmega2560::TCNT0) = static_cast<std::uint8_t>(256 - patience_counts);
}

inline void set_up_supervisor() {
  using namespace atmega2560;
  control_interrupt_came();
  byte(TCCR0B) = is_long_period ? by_1024 : by_64;
  byte(TIMSK0) = TOIE0;
}

/// Timer 3 counts half microseconds, independently of interrupts, and wraps after 33 ms. It starts in .init3
/// of avr-libc, so that it also counts the quarter of a millisecond in which variables are initialised before
/// main().
inline std::uint16_t log_clock() { return word(atmega2560::TCNT3L); }
static_assert(atmega2560::TCCR3B == 0x91 && atmega2560::by_8 == 2);
asm(".pushsection .init3,\"ax\",@progbits\n\t"
    "ldi r24, 2\n\t"
    "sts 0x91, r24\n\t"
    ".popsection");

/// Enables the pull-ups of port K, so that a broken wire reads 1 and not the signal of the neighbouring wire.
inline void set_up_hall_pins() {
  byte(atmega2560::PORTK) = 7;
  byte(atmega2560::PCMSK2) = 7;
  byte(atmega2560::PCICR) = atmega2560::PCIE2;
  pins_seen = hall_pins();  // from here on the Hall interrupt handles edges
}

inline void set_up_converter() {
  byte(atmega2560::ADCSRB) = atmega2560::ADTS_timer1_overflow;
  convert_at_bottom(pins_seen);
}

inline void set_up() {
  byte(atmega2560::DDRA) = 7;  // the lower gates become outputs, which are low
  set_up_serial_line();
  set_up_timer();
  set_up_hall_pins();
  set_up_converter();
  if (phase != Phase::stands) set_up_supervisor();
  byte(atmega2560::SMCR) = atmega2560::SE;  // sleep mode idle: timer, converter and serial line continue
}

}  // namespace firmware
