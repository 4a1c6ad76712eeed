// SPDX-License-Identifier: Apache-2.0
// What a program of this folder asks of the machine that it runs on, and the machine of it. One file per
// machine answers, and has the main.
#pragma once
#include <cstdint>

namespace target {

void run();  ///< the program

void put(char c);

/// Of a walk: told to a host's program, fixed on a chip.
std::uint32_t steps_wanted();

/// Where inputs are counted (digest.hpp), by block.
#ifdef TARGET_SIGHTS
void begins(const char* block);
#else
inline void begins(const char*) {}
#endif

}  // namespace target
