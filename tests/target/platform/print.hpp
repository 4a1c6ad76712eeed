// SPDX-License-Identifier: Apache-2.0
// Prints words and whole numbers, character by character.
#pragma once
#include "tests/target/platform/platform.hpp"

namespace target {

inline void print(const char* text) {
  for (; *text != 0; ++text) put(*text);
}
inline void print_number(std::uint32_t n) {
  char digits[11];
  char* p = digits + 10;
  *p = 0;
  do *--p = static_cast<char>('0' + n % 10);
  while ((n /= 10) != 0);
  print(p);
}
inline void print_hex(std::uint32_t n) {
  for (int shift = 28; shift >= 0; shift -= 4) put("0123456789abcdef"[(n >> shift) & 15]);
}

}  // namespace target
