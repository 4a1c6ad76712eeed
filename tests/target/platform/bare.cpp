// SPDX-License-Identifier: Apache-2.0
// What Cortex-M and RISC-V share: memory made ready, characters and the end by semihosting, and the three
// functions that compilers insert. They go by words where they can, as a C library's do: cycles of a library
// that nobody would flash are nobody's.
#include "tests/target/platform/platform.hpp"
#include "tests/target/platform/semihosting.hpp"

extern "C" {

using Size = decltype(sizeof 0);
extern std::uint32_t data_begin[], data_end[], data_in_flash[], bss_begin[], bss_end[];

// The barrier keeps the compiler from making a call of memcpy out of memcpy.
void* memcpy(void* to, const void* from, Size n) {
  auto* d = static_cast<std::uint8_t*>(to);
  const auto* s = static_cast<const std::uint8_t*>(from);
  if (((reinterpret_cast<Word>(d) | reinterpret_cast<Word>(s)) & 3) == 0)
    for (; n >= 4; n -= 4, d += 4, s += 4) {
      *reinterpret_cast<std::uint32_t*>(d) = *reinterpret_cast<const std::uint32_t*>(s);
      asm volatile("");
    }
  for (; n > 0; --n) {
    *d++ = *s++;
    asm volatile("");
  }
  return to;
}

void* memmove(void* to, const void* from, Size n) {
  auto* d = static_cast<std::uint8_t*>(to);
  const auto* s = static_cast<const std::uint8_t*>(from);
  if (d <= s) return memcpy(to, from, n);
  for (; n > 0; --n) {
    d[n - 1] = s[n - 1];
    asm volatile("");
  }
  return to;
}

void* memset(void* to, int value, Size n) {
  auto* d = static_cast<std::uint8_t*>(to);
  const std::uint32_t byte = static_cast<std::uint8_t>(value), word = byte * 0x01010101u;
  for (; n > 0 && (reinterpret_cast<Word>(d) & 3) != 0; --n) {
    *d++ = static_cast<std::uint8_t>(byte);
    asm volatile("");
  }
  for (; n >= 4; n -= 4, d += 4) {
    *reinterpret_cast<std::uint32_t*>(d) = word;
    asm volatile("");
  }
  for (; n > 0; --n) {
    *d++ = static_cast<std::uint8_t>(byte);
    asm volatile("");
  }
  return to;
}

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
