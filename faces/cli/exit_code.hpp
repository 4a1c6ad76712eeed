// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace cli {

/// What the shell is told; of several runs the gravest.
enum class Exit : int {
  ok = 0,             ///< all requirements hold
  failed = 1,         ///< a requirement failed
  bad_input = 2,      ///< also a file that cannot be read or written
  fault = 3,          ///< a fault stopped a run
  internal = 4,       ///< a mistake of the program
  interrupted = 130,  ///< by the user, as shells count it
};

inline Exit graver(Exit a, Exit b) { return static_cast<int>(a) > static_cast<int>(b) ? a : b; }

}  // namespace cli
