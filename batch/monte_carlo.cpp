// SPDX-License-Identifier: Apache-2.0
#include "batch/monte_carlo.hpp"

#include "batch/run.hpp"
#include "sixstep/study/scenario/spread.hpp"

namespace batch {

analysis::Series monte_carlo(const study::Scenario& scenario, const SeriesOptions& options) {
  analysis::Series series;
  run({.count = options.runs,
       .scenario = [&](std::size_t n) { return study::varied(scenario, options.seed, n); },
       .listeners = [](std::size_t) { return study::Listeners{.keep_books = false}; },
       .take =
           [&](std::size_t n, RunResult&& result) {
             analysis::add(series, result);
             if (options.each) options.each(n, result);
           },
       .progress = options.progress,
       .stop = options.stop,
       .jobs = options.jobs});
  return series;
}

}  // namespace batch
