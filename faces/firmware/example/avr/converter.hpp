// SPDX-License-Identifier: Apache-2.0
// The converter: at the timer's bottom, in the middle of the on-time, a phase current. Between two of those, in turns, the potentiometer,
// and the other two currents, the second of them from TOP on.
#pragma once
#include "faces/firmware/example/avr/board.hpp"

namespace firmware {

inline std::uint16_t converted() { return word(atmega2560::ADCL); }

inline void look_at_channel(std::uint8_t channel) {
  byte(atmega2560::ADMUX) = static_cast<std::uint8_t>(atmega2560::REFS0 | channel);
}

/// The transducer of the leg that feeds the positive pair: it carries the motor current, whatever its sign.
inline void look_at_source(std::uint8_t pins) { look_at_channel(by_pins.source[pins]); }

/// 16 MHz / 16: a conversion is 13 us. One that BOTTOM starts is 13.5 us and holds its sample 2 us behind it, and up to three cycles of the
/// trigger's. The data sheet has its 10 bits up to 200 kHz; a microsecond is worth one or two of them here.
constexpr std::uint8_t converter_on = atmega2560::ADEN | atmega2560::ADPS2;
constexpr std::uint16_t conversion_half_us = 2 * 13;

inline bool converts() { return (byte(atmega2560::ADCSRA) & atmega2560::ADSC) != 0; }

/// Its channel is held from the next edge of the converter's clock on: no interrupt that moves ADMUX may come within 16 cycles.
inline void convert(std::uint8_t channel) {
  look_at_channel(channel);
  byte(atmega2560::ADCSRA) = converter_on | atmega2560::ADSC;
}

inline std::uint16_t conversion() {
  while (converts()) continue;
  return converted();
}

/// The next BOTTOM, in the middle of the on-time, starts a conversion. The flag is cleared last: one set before the converter
/// listens would stand for ever, and only its edge counts. TOP's is cleared with it, for the next one.
inline void convert_at_bottom(std::uint8_t pins) {
  using namespace atmega2560;
  look_at_source(pins);
  byte(ADCSRA) = converter_on | ADATE | ADIE | ADIF;
  byte(TIFR1) = TOV1 | ICF1;
}

}  // namespace firmware
