// SPDX-License-Identifier: Apache-2.0
// Runs a comparison of controllers on all cores.
#pragma once
#include <cstdint>
#include <functional>
#include <stop_token>

#include "batch/rooms.hpp"
#include "sixstep/analysis/contest/contest.hpp"

namespace batch {

struct ContestOrder {
  std::size_t drives = 0;  ///< number of drives within the tolerances, per controller
  std::uint64_t seed = 1;
  unsigned jobs = 0;  ///< number of threads; 0: one per core
  analysis::UnitOfKey unit_of{};
  std::function<void(std::size_t done)>
      progress{};          ///< receives the number of finished runs, of nominal_runs() or of the drives;
                           ///< called from any thread
  std::stop_token stop{};  ///< ends the work early; the result is then not valid
};

/// Number of nominal runs. Each controller has two runs: on the course, and through the low speeds
/// (analysis::slow_scenario).
std::size_t nominal_runs(std::size_t controllers);

/// Runs each entry nominally, with a trace of the course. run_drives() runs the drives within the tolerances.
analysis::Contest compare_nominally(analysis::ContestBench bench, std::vector<analysis::ContestEntry> entries,
                                    const ContestOrder& order);

/// Runs all drives of the entries that can run, numbered as in the contest's plan, and passes each row to
/// `take`, from any thread. Drives for which `has` returns true are skipped, because their rows exist. Drive
/// n has the same deviations for all entries.
void run_drives(const analysis::Contest& contest, const ContestOrder& order,
                const std::function<bool(std::size_t number)>& has,
                const std::function<void(analysis::RunRecord&&)>& take);

}  // namespace batch
