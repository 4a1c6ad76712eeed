// SPDX-License-Identifier: Apache-2.0
// avr_board FIRMWARE.elf [WATCH..]: an ATmega2560 of simavr that prints what the firmware puts into GPIOR0 and ends when
// it writes GPIOR1. A program of its own: libsimavr is GPL-3, and nothing else here is linked with it.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

extern "C" {
#include <simavr/sim_avr.h>
#include <simavr/sim_elf.h>
#include <simavr/sim_io.h>
}

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  elf_firmware_t firmware{};
  if (elf_read_firmware(argv[1], &firmware) != 0) return 2;
  avr_t* avr = avr_make_mcu_by_name("atmega2560");
  avr_init(avr);
  avr->log = 0;
  firmware.frequency = 16000000;
  avr_load_firmware(avr, &firmware);
  bool done = false;
  avr_register_io_write(avr, 0x3E, [](avr_t*, avr_io_addr_t, std::uint8_t c, void*) { std::putchar(c); }, nullptr);
  avr_register_io_write(
      avr, 0x4A, [](avr_t*, avr_io_addr_t, std::uint8_t, void* to) { *static_cast<bool*>(to) = true; }, &done);
  while (!done) {
    const int state = avr_run(avr);
    if (state == cpu_Crashed || state == cpu_Done) {
      std::fprintf(stderr, "%s crashed at %x\n", argv[1], static_cast<unsigned>(avr->pc));
      return 3;
    }
  }
  return 0;
}
