// SPDX-License-Identifier: Apache-2.0
// Reads the board's options, which state the pin of each signal.
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "faces/firmware/example/avr/addresses.hpp"

namespace board {

struct Pin {
  char port = 'A';
  std::uint8_t bit = 0;

  /// Ports A to G are at 0x20 and above, H to L at 0x100 and above; there is no port I (data sheet 2549, 33).
  atmega2560::Address PIN() const {
    const int n = port <= 'G' ? port - 'A' : port == 'H' ? 0 : port - 'I';
    return static_cast<atmega2560::Address>((port <= 'G' ? 0x20 : 0x100) + 3 * n);
  }
  atmega2560::Address DDR() const { return static_cast<atmega2560::Address>(PIN() + 1); }
  atmega2560::Address PORT() const { return static_cast<atmega2560::Address>(PIN() + 2); }
  std::uint8_t mask() const { return static_cast<std::uint8_t>(1u << bit); }
};

struct Pins {
  Pin hall[3] = {{'K', 0}, {'K', 1}, {'K', 2}};  ///< the pins must be of port K
  Pin upper[3] = {{'B', 5}, {'B', 6}, {'B', 7}};
  Pin lower[3] = {{'A', 0}, {'A', 1}, {'A', 2}};
  std::uint8_t inputs[4] = {0, 1, 2,
                            3};  ///< inputs of the converter: currents of legs a, b, c, potentiometer

  /// The signal at an input of the converter, as the index 0 to 3 in `inputs`; -1: none.
  int what_hangs_at(unsigned channel) const {
    for (int n = 0; n < 4; ++n)
      if (inputs[n] == channel) return n;
    return -1;
  }
};

/// Reads three pins from a text such as "K0,K1,K2".
inline bool take_three(const char* said, Pin (&pins)[3]) {
  if (std::strlen(said) != 8 || said[2] != ',' || said[5] != ',') return false;
  for (std::size_t n = 0; n < 3; ++n) {
    const char port = said[3 * n], bit = said[3 * n + 1];
    if (port < 'A' || port > 'L' || port == 'I' || bit < '0' || bit > '7') return false;
    pins[n] = {port, static_cast<std::uint8_t>(bit - '0')};
  }
  return true;
}

/// Reads an option of the board's program. Returns false for any other word.
inline bool take_pins(const char* option, Pins& pins) {
  const auto behind = [option](const char* name) {
    return std::strncmp(option, name, std::strlen(name)) == 0 ? option + std::strlen(name) : nullptr;
  };
  if (const char* said = behind("--hall="))
    return take_three(said, pins.hall) && pins.hall[0].port == 'K' && pins.hall[1].port == 'K' &&
           pins.hall[2].port == 'K';
  if (const char* said = behind("--upper=")) return take_three(said, pins.upper);
  if (const char* said = behind("--lower=")) return take_three(said, pins.lower);
  const char* said = behind("--inputs=");
  if (said == nullptr || std::strlen(said) != 7) return false;
  for (std::size_t n = 0; n < 4; ++n) {
    if (said[2 * n] < '0' || said[2 * n] > '7' || (n < 3 && said[2 * n + 1] != ',')) return false;
    pins.inputs[n] = static_cast<std::uint8_t>(said[2 * n] - '0');
  }
  return true;
}

}  // namespace board
