// SPDX-License-Identifier: Apache-2.0
// The debugger's calls that a bare ARM or RISC-V program makes to its emulator (Arm, Semihosting for AArch32
// and AArch64, 2.0): operation in one register, block of words in the next.
#pragma once
#include <cstdint>

using Word = std::uint32_t;  ///< as wide as a pointer here

extern "C" Word semihosting(Word operation, const void* words);

namespace target {

inline void write_character(char c) { semihosting(0x03, &c); }

[[noreturn]] inline void exit_with(Word code) {
  const Word words[2] = {0x20026, code};  // the application ends by itself
  for (;;) semihosting(0x20, words);
}

/// 0 where there is no such file, else its handle plus 1.
inline Word open_to_read(const char* name, Word length) {
  const Word words[3] = {reinterpret_cast<Word>(name), 1, length};
  return semihosting(0x01, words) + 1;
}
/// Bytes that came.
inline Word read_file(Word handle_plus_1, void* to, Word bytes) {
  const Word words[3] = {handle_plus_1 - 1, reinterpret_cast<Word>(to), bytes};
  return bytes - semihosting(0x06, words);
}

}  // namespace target
