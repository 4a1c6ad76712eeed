// SPDX-License-Identifier: Apache-2.0
// Runs independent tasks, on several cores if the caller's function does.
#pragma once
#include <cstddef>
#include <functional>

namespace sixstep::analysis {

/// Calls work(0) .. work(count - 1), each once, in parallel or one after the other.
using ForEach = std::function<void(std::size_t count, const std::function<void(std::size_t)>& work)>;

inline void one_after_the_other(std::size_t count, const std::function<void(std::size_t)>& work) {
  for (std::size_t n = 0; n < count; ++n) work(n);
}

}  // namespace sixstep::analysis
