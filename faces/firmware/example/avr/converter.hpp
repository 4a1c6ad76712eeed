// SPDX-License-Identifier: Apache-2.0
// Uses the converter. At the timer's bottom, which is in the middle of the on-time, it samples a phase
// current. Between two of these samples it converts other inputs: alternately the potentiometer and the other
// two currents. The second of these two conversions starts at TOP.
#pragma once
#include "faces/firmware/example/avr/board.hpp"

namespace firmware {

inline std::uint16_t converted() { return word(atmega2560::ADCL); }

inline void look_at_channel(std::uint8_t channel) {
  byte(atmega2560::ADMUX) = static_cast<std::uint8_t>(atmega2560::REFS0 | channel);
}

/// Selects the transducer of the leg that feeds the positive pair, because this leg carries the motor current
/// of either sign.
inline void look_at_source(std::uint8_t pins) { look_at_channel(by_pins.source[pins]); }

/// The converter's clock is 16 MHz / 16: a conversion takes 13 us. A conversion that BOTTOM starts takes 13.5
/// us and holds its sample 2 us after BOTTOM, plus up to three cycles of the trigger. The data sheet
/// guarantees 10 bits only up to 200 kHz; here a short conversion is more important than one or two bits.
constexpr std::uint8_t converter_on = atmega2560::ADEN | atmega2560::ADPS2;
constexpr std::uint16_t conversion_half_us = 2 * 13;

inline bool converts() { return (byte(atmega2560::ADCSRA) & atmega2560::ADSC) != 0; }

/// Starts a conversion. The channel is locked only at the next edge of the converter's clock, so that no
/// interrupt that changes ADMUX may occur within 16 cycles.
inline void convert(std::uint8_t channel) {
  look_at_channel(channel);
  byte(atmega2560::ADCSRA) = converter_on | atmega2560::ADSC;
}

inline std::uint16_t conversion() {
  while (converts()) continue;
  return converted();
}

/// Makes the next BOTTOM, which is in the middle of the on-time, start a conversion. The flag is cleared
/// last: if it were set before the trigger is enabled, it would stay set, and only an edge of it starts a
/// conversion. TOP's flag is cleared as well, for the next TOP.
inline void convert_at_bottom(std::uint8_t pins) {
  using namespace atmega2560;
  look_at_source(pins);
  byte(ADCSRA) = converter_on | ADATE | ADIE | ADIF;
  byte(TIFR1) = TOV1 | ICF1;
}

}  // namespace firmware
