// SPDX-License-Identifier: Apache-2.0
// Under the sanitizers a simulation takes ten times as long: of cases that differ in numbers only, they see one in seven. And many
// cases that are alike are looked at in part by ./test and .ci/run, all of them by ctest --preset long.
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
  /// Of this case; the first is always looked at.
  bool leaves_out() { return n_++ % one_in != 0; }

 private:
  int n_ = 0;
};

}  // namespace sixstep::testing
