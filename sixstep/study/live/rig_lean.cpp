// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/compile/chip.hpp"
#include "sixstep/study/live/live_rig.hpp"
#include "sixstep/study/live/rigs.hpp"

namespace sixstep::study::detail {

MadeRun lean_run(const Scenario& s, const Compiled& c, rig::Timeline timeline) {
  using Lean = rig::LeanDrive<double>;
  return LiveRig<Lean, plant::Plant<double>>::made(chip_of<Lean>, s, c, std::move(timeline));
}

}  // namespace sixstep::study::detail
