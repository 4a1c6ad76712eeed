// SPDX-License-Identifier: Apache-2.0
// The converter: at the timer's bottom, in the middle of the on-time, a phase current; between two of those the potentiometer.
#pragma once
#include "faces/firmware/example/avr/board.hpp"

namespace firmware {

inline std::uint16_t converted() { return word(atmega2560::ADCL); }

inline void look_at_channel(std::uint8_t channel) {
  byte(atmega2560::ADMUX) = static_cast<std::uint8_t>(atmega2560::REFS0 | channel);
}

/// The transducer of the leg that feeds the positive pair: it carries the motor current, whatever its sign.
inline void look_at_source(std::uint8_t pins) { look_at_channel(by_pins.source[pins]); }

constexpr std::uint8_t converter_on = atmega2560::ADEN | atmega2560::ADPS2;  // 16 MHz / 16

inline void convert_potentiometer() {
  look_at_channel(potentiometer_channel);
  byte(atmega2560::ADCSRA) = converter_on | atmega2560::ADSC;
}

inline std::uint16_t potentiometer_counts() {
  while ((byte(atmega2560::ADCSRA) & atmega2560::ADSC) != 0) continue;
  return converted();
}

/// The next BOTTOM, in the middle of the on-time, starts a conversion. The flag is cleared last: one set before the converter
/// listens would stand for ever, and only its edge counts.
inline void convert_at_bottom() {
  using namespace atmega2560;
  byte(ADCSRA) = converter_on | ADATE | ADIE | ADIF;
  byte(TIFR1) = TOV1;
}

}  // namespace firmware
