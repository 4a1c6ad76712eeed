// SPDX-License-Identifier: Apache-2.0
// The functions that a program of this folder requires from its processor, and run(), which the program
// defines. For each processor, one file defines these functions and main().
#pragma once
#include <cstdint>

namespace target {

void run();  ///< the program; this folder's sources define it

void put(char c);
/// Reads the next bytes of a file of records. At the end of the file, it returns fewer than `bytes`.
std::uint16_t refill(const char* file, std::uint8_t* to, std::uint16_t bytes);
/// Calls an entry of a drive. On the ATmega2560, the call is an interrupt if GPIOR1 is not 0.
void call_entry(bool hall, void (*entry)());

/// Number of steps of a walk. On a host, it is an argument; on a chip, it is a constant.
std::uint32_t steps_wanted();

/// Starts the counts of inputs for the next block (digest.hpp).
#ifdef TARGET_SIGHTS
void begins(const char* block);
#else
inline void begins(const char*) {}
#endif

}  // namespace target
