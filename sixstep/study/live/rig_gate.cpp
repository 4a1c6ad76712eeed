// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/compile/chip.hpp"
#include "sixstep/study/live/rigs.hpp"
#include "sixstep/study/live/running_rig.hpp"

namespace sixstep::study::detail {

MadeRun gate_run(const Scenario& s, const Compiled& c, rig::Timeline timeline) {
  return RunningRig<rig::ChipDrive, plant::Plant<double>>::made(chip_of<rig::ChipDrive>, s, c,
                                                                std::move(timeline));
}

}  // namespace sixstep::study::detail
