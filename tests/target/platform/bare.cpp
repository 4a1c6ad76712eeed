// SPDX-License-Identifier: Apache-2.0
// What Cortex-M and RISC-V share: memory made ready, characters, files and the end by semihosting.
#include "tests/target/platform/platform.hpp"
#include "tests/target/platform/semihosting.hpp"

extern "C" {

extern std::uint32_t data_begin[], data_end[], data_in_flash[], bss_begin[], bss_end[];

[[noreturn]] void begin() {
  for (std::uint32_t *to = data_begin, *from = data_in_flash; to < data_end; ++to, ++from) *to = *from;
  for (std::uint32_t* to = bss_begin; to < bss_end; ++to) *to = 0;
  target::run();
  target::exit_with(0);
}

[[noreturn]] void hard_fault() { target::exit_with(3); }
}

namespace target {

void put(char c) { write_character(c); }
std::uint16_t refill(const char* name, std::uint8_t* to, std::uint16_t bytes) {
  static Word file = 0;
  Word length = 0;
  while (name[length] != 0) ++length;
  if (file == 0) file = open_to_read(name, length);
  return file == 0 ? std::uint16_t{0} : static_cast<std::uint16_t>(read_file(file, to, bytes));
}
void call_entry(bool, void (*entry)()) { entry(); }
std::uint32_t steps_wanted() { return 10000; }

}  // namespace target
