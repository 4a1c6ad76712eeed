// SPDX-License-Identifier: Apache-2.0
// Checks a scenario's run from inside, with any firmware and arithmetic. It checks the laws within each
// segment, and whether a copy of the rig from a control tick reaches the same end.
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
  bool finite = true;  ///< whether currents, speed, angle and bus are finite at every event
  double top_slack = 1.0;
  LawChecker<> laws;
  int resumed = 0, resumed_otherwise = 0;  ///< number of snapshots that ran to the end; number of those with
                                           ///< another end
};

struct WalkPlan {
  std::int64_t snapshot_every = 0;  ///< ticks from one snapshot to the next; 0: no snapshots
  int most_snapshots = 1000;
  std::int64_t most_segments = 1'000'000;
};

/// `compiled` must be the result of compiling `scenario`.
Walk walk(const study::Scenario& scenario, const study::Compiled& compiled, const WalkPlan& plan = {});

}  // namespace sixstep::testing
