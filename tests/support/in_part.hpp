// SPDX-License-Identifier: Apache-2.0
// Under the sanitizers a simulation takes ten times as long: of cases that differ in numbers only, they see one in seven.
#pragma once

namespace sixstep::testing {

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
