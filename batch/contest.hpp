// SPDX-License-Identifier: Apache-2.0
// Controllers set side by side, on all cores.
#pragma once
#include <cstdint>
#include <functional>
#include <stop_token>

#include "batch/rooms.hpp"
#include "sixstep/analysis/contest/contest.hpp"

namespace batch {

struct ContestOrder {
  std::size_t drives = 0;  ///< of the tolerances, for each controller
  std::uint64_t seed = 1;
  unsigned jobs = 0;                                 ///< threads; 0: one per core
  std::function<void(std::size_t done)> progress{};  ///< runs, of contest_runs(); from any thread
  std::stop_token stop{};                            ///< ends it early: what comes out then means nothing
};

std::size_t contest_runs(std::size_t controllers, std::size_t drives);

/// Each entry nominally, with a trace, then its drives as a plan. Drive n strays alike for all of them.
analysis::Contest compare_controllers(analysis::ContestBench bench,
                                      std::vector<analysis::ContestEntry> entries, const ContestOrder& order);

}  // namespace batch
