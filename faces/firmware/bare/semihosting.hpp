// SPDX-License-Identifier: Apache-2.0
// Defines the semihosting calls that a bare ARM or RISC-V program makes to its emulator (Arm, Semihosting for
// AArch32 and AArch64, 2.0): operation in one register, address of a block of words in the next.
#pragma once
#include <cstdint>

using Word = std::uint32_t;  ///< as wide as a pointer on these cores

extern "C" Word semihosting(Word operation, const void* words);

namespace target {

inline void write_character(char c) { semihosting(0x03, &c); }

[[noreturn]] inline void exit_with(Word code) {
  const Word words[2] = {0x20026, code};  // the reason ADP_Stopped_ApplicationExit, and the exit code
  for (;;) semihosting(0x20, words);
}

/// Modes of fopen(), numbered as in Arm's convention.
enum class FileMode : Word { read = 1, write = 5 };  // "rb" and "wb"

/// The file's handle plus 1; 0 if the file cannot be opened.
inline Word open_file(const char* name, Word length, FileMode mode) {
  const Word words[3] = {reinterpret_cast<Word>(name), static_cast<Word>(mode), length};
  return semihosting(0x01, words) + 1;
}
inline Word open_to_read(const char* name, Word length) { return open_file(name, length, FileMode::read); }
/// Returns the number of bytes read.
inline Word read_file(Word handle_plus_1, void* to, Word bytes) {
  const Word words[3] = {handle_plus_1 - 1, reinterpret_cast<Word>(to), bytes};
  return bytes - semihosting(0x06, words);
}
/// Returns whether all bytes were written.
inline bool write_file(Word handle_plus_1, const void* from, Word bytes) {
  const Word words[3] = {handle_plus_1 - 1, reinterpret_cast<Word>(from), bytes};
  return semihosting(0x05, words) == 0;
}

}  // namespace target
