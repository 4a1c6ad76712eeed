// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/live/rigs.hpp"
#include "sixstep/study/live/running_rig.hpp"

namespace sixstep::study::detail {

MadeRun leg_run_on_general(LegChip (*chip)(const Scenario&, const Compiled&), const Scenario& s,
                           const Compiled& c, rig::Timeline timeline) {
  return RunningRig<rig::LegDrive, plant::general::Plant<double>>::made(chip, s, c, std::move(timeline));
}

}  // namespace sixstep::study::detail
