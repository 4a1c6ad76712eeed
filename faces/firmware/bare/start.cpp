// SPDX-License-Identifier: Apache-2.0
// The code between reset and program on Cortex-M and RISC-V: prepares the memory, calls the program, and
// exits.
#include "faces/firmware/bare/semihosting.hpp"

namespace target {
void run();  // the program's function
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
