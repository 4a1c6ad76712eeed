// SPDX-License-Identifier: Apache-2.0
// A series of drives, run side by side and judged together.
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <stop_token>

#include "batch/rooms.hpp"
#include "sixstep/analysis/series/series.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace batch {

struct SeriesOptions {
  std::size_t runs = 0;
  std::uint64_t seed = 0;
  unsigned jobs = 0;
  std::stop_token stop;
  std::function<void(std::size_t done)> progress;
  /// Each run as it is counted, in order, before its outcome is dropped. No books are kept of it.
  std::function<void(std::size_t n, const base::Result<study::Outcome>&)> each;
};

/// Runs 0 .. runs - 1 of the series (study::varied). Memory: eight bytes per run and figure.
analysis::Series monte_carlo(const study::Scenario& scenario, const SeriesOptions& options);

}  // namespace batch
