// SPDX-License-Identifier: Apache-2.0
// Independent studies side by side.
#pragma once
#include <cstddef>
#include <functional>

namespace batch {

/// Calls work(0) .. work(count - 1), each once, on up to `jobs` threads (0: one per core). Which runs when is
/// left open; each result must go into its own place. The first exception of a work is thrown again here,
/// after all ended.
void for_each(std::size_t count, unsigned jobs, const std::function<void(std::size_t)>& work);

/// for_each with its threads settled: for those who leave that to others.
inline auto on_threads(unsigned jobs) {
  return [jobs](std::size_t count, const std::function<void(std::size_t)>& work) {
    for_each(count, jobs, work);
  };
}

}  // namespace batch
