// SPDX-License-Identifier: Apache-2.0
// walk() for one kind of drive. Each kind has a separate source file, so that the files can be compiled in
// parallel.
#pragma once
#include <cmath>

#include "sixstep/study/compile/rig_of.hpp"
#include "sixstep/study/measure/digest.hpp"
#include "tests/support/scenario_walk.hpp"

namespace sixstep::testing {

Walk walk_lean(const study::Scenario& scenario, const study::Compiled& compiled, const WalkPlan& plan);
Walk walk_pair(const study::Scenario& scenario, const study::Compiled& compiled, const WalkPlan& plan);
Walk walk_legs(const study::Scenario& scenario, const study::Compiled& compiled, const WalkPlan& plan);

namespace detail {

template <class Rig>
struct Snapshot {
  Rig rig;
  study::Digest digest;
};

/// Checks every segment of the whole run. If the run was resumed from a snapshot, it only updates the digest.
template <class Rig>
struct Walker {
  study::Digest digest;
  Walk* walk = nullptr;
  const WalkPlan* plan = nullptr;
  std::vector<Snapshot<Rig>>* snapshots = nullptr;
  bool ticked = false;
  std::int64_t segments = 0;

  void segment(const Rig& rig, double s) {
    digest.segment(rig, s);
    ticked = rig.ticked();
    ++segments;
    if (!walk) return;
    walk->laws.segment(rig, s);
    const auto& y = rig.plant().state();
    walk->finite = walk->finite && std::isfinite(y.i[0] + y.i[1] + y.i[2]) && std::isfinite(y.w) &&
                   std::isfinite(y.x) && std::isfinite(y.bus);
    walk->top_slack = std::max(walk->top_slack, rig.plant().slack());
  }
  bool done(const Rig& rig) {
    if (walk && ticked && plan->snapshot_every > 0 && walk->ticks++ % plan->snapshot_every == 0 &&
        static_cast<int>(snapshots->size()) < plan->most_snapshots)
      snapshots->push_back({rig, digest});
    return segments >= plan->most_segments;
  }
};

template <class Rig>
Walk walk_rig(Rig rig, sim::Instant end, const WalkPlan& plan) {
  Walk out;
  std::vector<Snapshot<Rig>> snapshots;
  Walker<Rig> walker{.walk = &out, .plan = &plan, .snapshots = &snapshots};
  const sim::Run run = sim::run(rig, end, walker);
  out.stop = run.stop;
  out.segments = run.segments;
  out.digest = walker.digest.after(rig);
  for (Snapshot<Rig>& snapshot : snapshots) {
    Walker<Rig> again{.digest = snapshot.digest, .plan = &plan};
    const sim::Run rest = sim::run(snapshot.rig, end, again);
    ++out.resumed;
    if (rest.stop != run.stop || again.digest.after(snapshot.rig) != out.digest) ++out.resumed_otherwise;
  }
  return out;
}

template <class Firmware>
Walk walk_with(const base::Result<study::Chip<Firmware>>& chip, const study::Compiled& c,
               const WalkPlan& plan) {
  if (!chip) return {.problems = chip.problems()};
  if (c.general) return walk_rig(study::general_rig_of<Firmware>(c, *chip, c.timeline), c.end, plan);
  return walk_rig(study::rig_of<Firmware>(c, *chip, c.timeline), c.end, plan);
}

}  // namespace detail
}  // namespace sixstep::testing
