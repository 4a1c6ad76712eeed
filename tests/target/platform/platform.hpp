// SPDX-License-Identifier: Apache-2.0
// What a program of this folder asks of the machine that it runs on, and the machine of it. One file per
// machine answers, and has the main.
#pragma once
#include <cstdint>

namespace target {

void run();  ///< the program

void put(char c);
/// The next bytes of a file of records, less than wanted at its end.
std::uint16_t refill(const char* file, std::uint8_t* to, std::uint16_t bytes);
/// Calls an entry of a drive; the ATmega2560 as an interrupt, where it is told so.
void call_entry(bool hall, void (*entry)());

/// Of a walk: told to a host's program, fixed on a chip.
std::uint32_t steps_wanted();

/// Where inputs are counted (digest.hpp), by block.
#ifdef TARGET_SIGHTS
void begins(const char* block);
#else
inline void begins(const char*) {}
#endif

}  // namespace target
