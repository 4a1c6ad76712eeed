// SPDX-License-Identifier: Apache-2.0
// Checks that the fuzzers of the readers apply to each result.
#pragma once
#include <cstdlib>

#include "sixstep/study/compile/compile.hpp"
#include "sixstep/study/scenario/spread.hpp"

namespace fuzzing {

/// Each problem of a refusal names a place and a rule.
inline void must_say_something(const sixstep::base::Problems& problems) {
  if (problems.empty()) std::abort();
  for (const sixstep::base::Problem& problem : problems)
    if (problem.where.empty() || problem.limit.empty()) std::abort();
}

/// An accepted scenario compiles, or it is refused with a message. The same law applies to the drives of its
/// spread.
inline void must_compile(const sixstep::study::Scenario& scenario) {
  const auto compiled = sixstep::study::compile(scenario);
  if (!compiled && compiled.problems().empty()) std::abort();
  if (scenario.spread.empty()) return;
  for (const std::uint64_t drive : {0, 1, 2}) {
    const auto strayed = sixstep::study::compile(sixstep::study::varied(scenario, 1, drive));
    if (!strayed && strayed.problems().empty()) std::abort();
  }
}

}  // namespace fuzzing
