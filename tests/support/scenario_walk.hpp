// SPDX-License-Identifier: Apache-2.0
// Checks a scenario's run from inside, with any firmware and arithmetic: the laws within each segment, and
// whether a copy of the rig taken at a control tick reaches the same end.
#pragma once
#include <cstdint>
#include <vector>

#include "sixstep/sim/run.hpp"
#include "sixstep/study/compile/compile.hpp"
#include "tests/support/laws.hpp"

namespace sixstep::testing {

struct Walk {
  base::Problems
      problems;  ///< why the arithmetic cannot represent the drive; the other members are then empty
  sim::Stop stop = sim::Stop::end;
  std::int64_t segments = 0, ticks = 0;
  std::uint64_t digest = 0;
  bool finite = true;  ///< currents, speed, angle and bus at every event
  double top_slack = 1.0;
  LawChecker<> laws;
  int resumed = 0, resumed_otherwise = 0;  ///< snapshots that were run to the end; those that ended elsewhere
};

struct WalkPlan {
  std::int64_t snapshot_every = 0;  ///< ticks from one snapshot to the next; 0: none
  int most_snapshots = 1000;
  std::int64_t most_segments = 1'000'000;
};

/// `compiled` must belong to the scenario.
Walk walk(const study::Scenario& scenario, const study::Compiled& compiled, const WalkPlan& plan = {});

}  // namespace sixstep::testing
