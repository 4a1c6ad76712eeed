// SPDX-License-Identifier: Apache-2.0
// Combines each kernel with each kind of drive; each combination is compiled in the file rig_* with its name.
#pragma once
#include "sixstep/study/live/any_run.hpp"
#include "sixstep/study/live/chips.hpp"

namespace sixstep::study::detail {

using MadeRun = base::Result<std::unique_ptr<AnyRun>>;

/// The lean drive with ideal sensors, in double on the lean kernel. The rig calls it directly, without the
/// interface of any_drive.hpp. Most plans use this run.
MadeRun lean_run(const Scenario& s, const Compiled& c, rig::Timeline timeline);
/// Drives that command a pair and one duty.
MadeRun pair_run(PairChip (*chip)(const Scenario&, const Compiled&), const Scenario& s, const Compiled& c,
                 rig::Timeline timeline);
MadeRun pair_run_on_general(PairChip (*chip)(const Scenario&, const Compiled&), const Scenario& s,
                            const Compiled& c, rig::Timeline timeline);
/// Drives that command three legs.
MadeRun leg_run(LegChip (*chip)(const Scenario&, const Compiled&), const Scenario& s, const Compiled& c,
                rig::Timeline timeline);
MadeRun leg_run_on_general(LegChip (*chip)(const Scenario&, const Compiled&), const Scenario& s,
                           const Compiled& c, rig::Timeline timeline);
/// A chip with its own firmware, which sets the gates itself.
MadeRun gate_run(const Scenario& s, const Compiled& c, rig::Timeline timeline);
MadeRun gate_run_on_general(const Scenario& s, const Compiled& c, rig::Timeline timeline);

}  // namespace sixstep::study::detail
