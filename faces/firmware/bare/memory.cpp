// SPDX-License-Identifier: Apache-2.0
// Defines the three functions that compilers insert to copy and clear structs. They copy words where
// possible, like a C library. A byte-wise copy would add instructions to the counts that no real firmware
// executes.
#include <cstdint>

using Size = decltype(sizeof 0);
using Address = std::uint32_t;  // as wide as a pointer on these cores

extern "C" {

// The barrier prevents the compiler from replacing the loop by a call of memcpy.
void* memcpy(void* to, const void* from, Size n) {
  auto* d = static_cast<std::uint8_t*>(to);
  const auto* s = static_cast<const std::uint8_t*>(from);
  if (((reinterpret_cast<Address>(d) | reinterpret_cast<Address>(s)) & 3) == 0)
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
  for (; n > 0 && (reinterpret_cast<Address>(d) & 3) != 0; --n) {
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
}
