// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/compile/chip.hpp"
#include "sixstep/study/live/rigs.hpp"
#include "sixstep/study/live/running_rig.hpp"

namespace sixstep::study::detail {

MadeRun lean_run(const Scenario& s, const Compiled& c, rig::Timeline timeline) {
  using Lean = rig::LeanDrive<double>;
  return RunningRig<Lean, plant::Plant<double>>::made(chip_of<Lean>, s, c, std::move(timeline));
}

}  // namespace sixstep::study::detail
