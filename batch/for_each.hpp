// SPDX-License-Identifier: Apache-2.0
// Runs independent studies in parallel.
#pragma once
#include <cstddef>
#include <functional>

namespace batch {

/// Calls work(0) .. work(count - 1), each once, on up to `jobs` threads (0: one per core), in any order. Each
/// call must write its result to a separate place. If calls throw, the first exception is rethrown after all
/// calls have ended.
void for_each(std::size_t count, unsigned jobs, const std::function<void(std::size_t)>& work);

/// for_each() with a fixed number of threads, as an argument for functions that leave the number of threads
/// to their caller.
inline auto on_threads(unsigned jobs) {
  return [jobs](std::size_t count, const std::function<void(std::size_t)>& work) {
    for_each(count, jobs, work);
  };
}

}  // namespace batch
