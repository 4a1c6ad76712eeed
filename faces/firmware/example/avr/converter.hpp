// SPDX-License-Identifier: Apache-2.0
// Controls the converter. At the timer's BOTTOM, in the middle of the on-time, the converter samples a phase
// current. Between two such samples, it converts other inputs: alternately the potentiometer and the two
// other phase currents. The second of these two currents is converted from TOP on.
#pragma once
#include "faces/firmware/example/avr/board.hpp"

namespace firmware {

inline std::uint16_t converted() { return word(atmega2560::ADCL); }

inline void look_at_channel(std::uint8_t channel) {
  byte(atmega2560::ADMUX) = static_cast<std::uint8_t>(atmega2560::REFS0 | channel);
}

/// Selects the transducer of the leg that feeds the driven pair. The current of this leg is the motor
/// current, with its sign.
inline void look_at_source(std::uint8_t pins) { look_at_channel(by_pins.source[pins]); }

/// The converter's clock is 16 MHz / 16, so a conversion takes 13 us. A conversion started by BOTTOM takes
/// 13.5 us. It samples 2 us after BOTTOM, plus up to three cycles of the trigger. The data sheet guarantees
/// 10 bits only up to 200 kHz. A short conversion is more important here than one or two bits.
constexpr std::uint8_t converter_on = atmega2560::ADEN | atmega2560::ADPS2;
constexpr std::uint16_t conversion_half_us = 2 * 13;

inline bool converts() { return (byte(atmega2560::ADCSRA) & atmega2560::ADSC) != 0; }

/// Starts a conversion. The channel is latched only at the next edge of the converter's clock, so no
/// interrupt may change ADMUX within 16 cycles.
inline void convert(std::uint8_t channel) {
  look_at_channel(channel);
  byte(atmega2560::ADCSRA) = converter_on | atmega2560::ADSC;
}

inline std::uint16_t conversion() {
  while (converts()) continue;
  return converted();
}

/// Lets the next BOTTOM, in the middle of the on-time, start a conversion. The flag TOV1 is cleared last. If
/// it were set before the trigger is enabled, it would stay set, and only a rising edge of the flag starts a
/// conversion. TOP's flag ICF1 is cleared as well.
inline void convert_at_bottom(std::uint8_t pins) {
  using namespace atmega2560;
  look_at_source(pins);
  byte(ADCSRA) = converter_on | ADATE | ADIE | ADIF;
  byte(TIFR1) = TOV1 | ICF1;
}

}  // namespace firmware
