// SPDX-License-Identifier: Apache-2.0
// Lists registers of an ATmega2560 by their data-memory addresses, and their bits. The firmware writes these
// registers, and the emulated board (faces/loop/avr/) models them. Source: Atmel data sheet 2549, register
// summary (33) and interrupt vectors (14.1).
#pragma once
#include <cstdint>

namespace atmega2560 {

using Address = std::uint16_t;

constexpr Address PINA = 0x20, DDRA = 0x21, PORTA = 0x22;
constexpr Address PINB = 0x23, DDRB = 0x24, PORTB = 0x25;
constexpr Address PINK = 0x106, PORTK = 0x108;
constexpr Address TIFR1 = 0x36, PCIFR = 0x3B, SMCR = 0x53, PCICR = 0x68, PCMSK2 = 0x6D, TIMSK1 = 0x6F;
constexpr Address TCCR0B = 0x45, TCNT0 = 0x46, TIMSK0 = 0x6E;
constexpr Address TIFR3 = 0x38, TCCR3B = 0x91, TCNT3L = 0x94;
constexpr Address ADCL = 0x78, ADCH = 0x79, ADCSRA = 0x7A, ADCSRB = 0x7B, ADMUX = 0x7C;
constexpr Address TCCR1A = 0x80, TCCR1B = 0x81, TCNT1L = 0x84, ICR1L = 0x86;
constexpr Address OCR1AL = 0x88, OCR1BL = 0x8A, OCR1CL = 0x8C, OCR1CH = 0x8D;
constexpr Address MCUSR = 0x54, SREG = 0x5F, WDTCSR = 0x60;
constexpr Address UCSR0A = 0xC0, UCSR0B = 0xC1, UCSR0C = 0xC2, UBRR0L = 0xC4, UDR0 = 0xC6;

constexpr std::uint8_t ICF1 = 1u << 5, TOV1 = 1u << 0, ICIE1 = 1u << 5;                  // TIFR1, TIMSK1
constexpr std::uint8_t TOIE0 = 1u << 0, TOV3 = 1u << 0;                                  // TIMSK0, TIFR3
constexpr std::uint8_t by_8 = 2, by_64 = 3, by_1024 = 5;                                 // CSn2..0, of TCCRnB
constexpr std::uint8_t COM1A1 = 1u << 7, COM1B1 = 1u << 5, COM1C1 = 1u << 3;             // TCCR1A
constexpr std::uint8_t WGM11 = 1u << 1;                                                  // TCCR1A
constexpr std::uint8_t WGM13 = 1u << 4, CS10 = 1u << 0;                                  // TCCR1B
constexpr std::uint8_t ADEN = 1u << 7, ADSC = 1u << 6, ADATE = 1u << 5, ADIF = 1u << 4;  // ADCSRA
constexpr std::uint8_t ADIE = 1u << 3, ADPS2 = 1u << 2;                                  // ADCSRA
constexpr std::uint8_t MUX5 = 1u << 3, ADTS_bits = 7, ADTS_timer1_overflow = 6;          // ADCSRB
constexpr std::uint8_t REFS0 = 1u << 6, ADLAR = 1u << 5, MUX_bits = 31;                  // ADMUX
constexpr std::uint8_t PCIE2_bit = 2, PCIE2 = 1u << PCIE2_bit;                           // PCICR, and PCIFR
constexpr std::uint8_t SE = 1u << 0;                                                     // SMCR
constexpr std::uint8_t WDRF = 1u << 3;                                                   // MCUSR
constexpr std::uint8_t WDE = 1u << 3, WDCE = 1u << 4;                                    // WDTCSR
constexpr std::uint8_t UDRE0 = 1u << 5, U2X0 = 1u << 1;                                  // UCSR0A
constexpr std::uint8_t TXEN0 = 1u << 3;                                                  // UCSR0B
constexpr std::uint8_t UCSZ01 = 1u << 2, UCSZ00 = 1u << 1;                               // UCSR0C

constexpr unsigned vector_PCINT2 = 11, vector_TIMER1_CAPT = 16, vector_TIMER1_OVF = 20, vector_ADC = 29;

}  // namespace atmega2560
