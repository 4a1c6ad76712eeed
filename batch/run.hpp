// SPDX-License-Identifier: Apache-2.0
// Many independent runs on all cores. Each is what it would be alone, to the bit: nothing is shared between
// them, and what is made of them is made in the order of their numbers.
#pragma once
#include <cstddef>
#include <functional>
#include <stop_token>

#include "batch/rooms.hpp"
#include "sixstep/base/result.hpp"
#include "sixstep/study/run/run.hpp"

namespace batch {

/// A run that a fault stopped has an outcome that says so; one that could not start is its Problems.
using RunResult = base::Result<study::Outcome>;

struct Runs {
  std::size_t count = 0;
  /// The scenario of run n; called on any thread, several at once.
  std::function<study::Scenario(std::size_t n)> scenario;
  /// Who listens to run n; called as `scenario`. Without it no trace is made.
  std::function<study::Listeners(std::size_t n)> listeners;
  /// Each result, in the order of the runs, never two at once. What it does not keep is gone: no more than
  /// results_ahead wait for their turn, whatever the count.
  std::function<void(std::size_t n, RunResult&&)> take;
  /// How many runs have ended so far, in whatever order; never two at once.
  std::function<void(std::size_t done)> progress;
  std::stop_token stop;  ///< ends the runs under way, too
  unsigned jobs = 0;     ///< threads; 0: one per core
};

/// A thread that is this far ahead of the oldest run under way waits for it.
inline constexpr std::size_t results_ahead = 256;

/// Returns how many results were taken: all, or after a stop those of the runs 0, 1, .. up to the first that
/// was cut short or never began. An exception of one of the functions ends the batch and is thrown again
/// here.
std::size_t run(const Runs& runs);

}  // namespace batch
