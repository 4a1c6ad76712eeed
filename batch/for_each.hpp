// SPDX-License-Identifier: Apache-2.0
// Runs independent studies in parallel.
#pragma once
#include <cstddef>
#include <functional>

namespace batch {

/// Calls work(0) .. work(count - 1), each once, on up to `jobs` threads (0: one per core), in any order; each
/// result must go into its own place. After all have ended, the first exception of a call is rethrown.
void for_each(std::size_t count, unsigned jobs, const std::function<void(std::size_t)>& work);

/// for_each with a fixed number of threads, for callers that leave the choice to others.
inline auto on_threads(unsigned jobs) {
  return [jobs](std::size_t count, const std::function<void(std::size_t)>& work) {
    for_each(count, jobs, work);
  };
}

}  // namespace batch
