// SPDX-License-Identifier: Apache-2.0
// Runs a firmware on an ATmega2560, in lock-step with a plant behind two pipes:
//
//   sixstep-avr-board [--hall=K0,K1,K2] [--upper=B5,B6,B7] [--lower=A0,A1,A2] [--inputs=0,1,2,3]
//   [--serial=FILE] FIRMWARE.elf
//
// The program reads runs from descriptor 3 and writes answers to 4 (sixstep/rig/chip_port.hpp). The options
// state the connected pins, with legs in the order a, b, c. --inputs states the converter's inputs for the
// three currents and the potentiometer. FILE receives the output of USART0, line by line.
//
// It is a separate program because libsimavr is GPL-3, and no other part may be linked with libsimavr.
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "faces/loop/avr/chip.hpp"

namespace {

namespace rig = sixstep::rig;

constexpr int runs = 3, answers = 4;
constexpr char serial_option[] = "--serial=";

/// Reads exactly this number of bytes. Returns false at the end of the pipe.
bool take(void* to, std::size_t bytes) {
  for (char* at = static_cast<char*>(to); bytes > 0;) {
    const ssize_t n = ::read(runs, at, bytes);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    at += n;
    bytes -= static_cast<std::size_t>(n);
  }
  return true;
}

template <class Struct>
bool tell(const Struct& what) {
  const char* at = reinterpret_cast<const char*>(&what);
  for (std::size_t bytes = sizeof what; bytes > 0;) {
    const ssize_t n = ::write(answers, at, bytes);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    at += n;
    bytes -= static_cast<std::size_t>(n);
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  board::Pins pins;
  const char* serial = nullptr;
  bool understood = argc >= 2;
  for (int n = 1; n + 1 < argc; ++n) {
    if (std::strncmp(argv[n], serial_option, sizeof serial_option - 1) == 0)
      serial = argv[n] + sizeof serial_option - 1;
    else
      understood = understood && board::take_pins(argv[n], pins);
  }
  if (!understood) {
    std::fputs(
        "usage: sixstep-avr-board [--hall=..] [--upper=..] [--lower=..] [--inputs=..] [--serial=FILE] FIRMWARE.elf, with pipes at "
        "descriptors 3 and 4\n",
        stderr);
    return 2;
  }
  std::FILE* const sent = serial == nullptr ? nullptr : std::fopen(serial, "wb");
  if (serial != nullptr && sent == nullptr) {
    std::fprintf(stderr, "sixstep-avr-board: %s cannot be written\n", serial);
    return 2;
  }
  // The file is written line by line, because the parent process may end this process at any time.
  if (sent != nullptr && std::setvbuf(sent, nullptr, _IOLBF, 4096) != 0) return 2;
  static board::Chip chip(pins, sent);
  if (!chip.load(argv[argc - 1])) {
    std::fprintf(stderr, "sixstep-avr-board: %s is not a program for an ATmega2560\n", argv[argc - 1]);
    return 2;
  }
  if (!tell(rig::ChipGreeting{.clock_Hz = board::Chip::clock_Hz})) return 3;
  for (rig::ChipRun run; take(&run, sizeof run);)
    if (!(run.asks_for_times != 0 ? tell(chip.times()) : tell(chip.run(run)))) return 3;
  return 0;
}
