// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/compile/chip.hpp"
#include "sixstep/study/live/live_rig.hpp"
#include "sixstep/study/live/rigs.hpp"

namespace sixstep::study::detail {

MadeRun gate_run_on_general(const Scenario& s, const Compiled& c, rig::Timeline timeline) {
  return LiveRig<rig::ChipDrive, plant::general::Plant<double>>::made(chip_of<rig::ChipDrive>, s, c,
                                                                      std::move(timeline));
}

}  // namespace sixstep::study::detail
