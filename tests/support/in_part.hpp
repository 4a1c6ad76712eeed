// SPDX-License-Identifier: Apache-2.0
// Selects a part of many similar cases. Under the sanitizers, a simulation takes ten times as long. If the
// cases differ only in numbers, the sanitizers therefore run one case in seven. ./test and .ci/run run a part
// of the cases; ctest --preset long runs all cases.
#pragma once
#include <cstdlib>

namespace sixstep::testing {

inline bool all_cases() { return std::getenv("SIXSTEP_ALL_CASES") != nullptr; }

#if defined(__SANITIZE_ADDRESS__)
inline constexpr int one_in = 7;
#else
inline constexpr int one_in = 1;
#endif

class InPart {
 public:
  /// Returns true if the test must skip this case. The first case is never skipped.
  bool leaves_out() { return n_++ % one_in != 0; }

 private:
  int n_ = 0;
};

}  // namespace sixstep::testing
