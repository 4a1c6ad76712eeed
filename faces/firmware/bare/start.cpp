// SPDX-License-Identifier: Apache-2.0
// What Cortex-M and RISC-V do alike between their reset and the program: memory made ready, and the end.
#include "faces/firmware/bare/semihosting.hpp"

namespace target {
void run();  // the program
}

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
