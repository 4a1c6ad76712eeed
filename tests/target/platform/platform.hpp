// SPDX-License-Identifier: Apache-2.0
// The functions that a program of this folder needs from its machine, and the one that it provides. Each
// machine has one file with these functions and the main.
#pragma once
#include <cstdint>

namespace target {

void run();  ///< the program, which this folder's sources provide

void put(char c);
/// Reads the next bytes of a file of records, fewer than `bytes` at its end.
std::uint16_t refill(const char* file, std::uint8_t* to, std::uint16_t bytes);
/// Calls an entry of a drive; on the ATmega2560 as an interrupt where GPIOR1 is not 0.
void call_entry(bool hall, void (*entry)());

/// The steps of a walk: an argument on a host, a constant on a chip.
std::uint32_t steps_wanted();

/// Begins a block of the counts of inputs (digest.hpp).
#ifdef TARGET_SIGHTS
void begins(const char* block);
#else
inline void begins(const char*) {}
#endif

}  // namespace target
