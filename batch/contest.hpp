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
  unsigned jobs = 0;  ///< threads; 0: one per core
  analysis::UnitOfKey unit_of{};
  std::function<void(std::size_t done)>
      progress{};          ///< runs that are made, of nominal_runs() or the drives; from any thread
  std::stop_token stop{};  ///< ends it early: what comes out then means nothing
};

/// Each entry twice: on the course, and as slowly as it goes.
std::size_t nominal_runs(std::size_t controllers);

/// Each entry nominally, with a trace of the course. Its drives are still to be made, and taken.
analysis::Contest compare_nominally(analysis::ContestBench bench, std::vector<analysis::ContestEntry> entries,
                                    const ContestOrder& order);

/// The drives of all entries that can run, by their numbers in the contest's plan, each row to `take`, from any thread; those that `has`
/// names stand already. Drive n strays alike for all entries.
void run_drives(const analysis::Contest& contest, const ContestOrder& order,
                const std::function<bool(std::size_t number)>& has,
                const std::function<void(analysis::RunRecord&&)>& take);

}  // namespace batch
