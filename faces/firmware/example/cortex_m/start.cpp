// SPDX-License-Identifier: Apache-2.0
// The code from the reset to the program, and the handler of the core's faults.
#include "faces/firmware/example/cortex_m/kept.hpp"
#include "faces/firmware/example/cortex_m/registers.hpp"

int main();

extern "C" {

extern std::uint32_t data_begin[], data_end[], data_in_flash[], bss_begin[], bss_end[];
using Constructor = void (*)();
extern const Constructor constructors_begin[], constructors_end[];

[[noreturn]] void begin() {
  for (std::uint32_t *to = data_begin, *from = data_in_flash; to < data_end; ++to, ++from) *to = *from;
  for (std::uint32_t* to = bss_begin; to < bss_end; ++to) *to = 0;
  for (const Constructor* construct = constructors_begin; construct < constructors_end; ++construct)
    (*construct)();
  main();
  for (;;) continue;
}

/// Turns all gates off at once, then waits for the watchdog's reset.
[[noreturn]] void fault() {
  using namespace firmware;
  tim1().BDTR = tim1().BDTR & ~bit::MOE;
  kept_reason.keep(Reason::program);
  for (;;) asm volatile("");
}
}
