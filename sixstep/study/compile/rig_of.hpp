// SPDX-License-Identifier: Apache-2.0
// Motor, bridge, chip and timeline of a run as the rig that sim::run drives.
#pragma once
#include "sixstep/plant/general/plant.hpp"
#include "sixstep/rig/rig.hpp"
#include "sixstep/study/compile/compile.hpp"

namespace sixstep::study {

/// What a firmware is given in the number its chip computes in.
template <class Firmware>
struct Chip {
  typename Firmware::Config config;
  rig::Bases bases;
  std::vector<rig::Tuning<typename Firmware::Config>> later;  ///< what the timeline's retune actions name
  FullScale full_scale{};                                     ///< of fixed point: for the whole run
};

template <class Firmware>
rig::Rig<double, Firmware> rig_of(const Compiled& c, const Chip<Firmware>& chip, rig::Timeline timeline) {
  const plant::Plant<double> plant(c.motor.machine, c.shaft, c.devices, c.supply, c.start);
  rig::BoardConfig board = c.board;
  board.bases = chip.bases;
  return {plant, chip.config, board, std::move(timeline), chip.later};
}

/// Of a scenario that the general kernel runs.
template <class Firmware>
using GeneralRig = rig::Rig<double, Firmware, plant::general::Plant<double>>;
template <class Firmware>
GeneralRig<Firmware> general_rig_of(const Compiled& c, const Chip<Firmware>& chip, rig::Timeline timeline) {
  const GeneralPlant& g = *c.general;
  const plant::general::Plant<double> plant(g.machine, g.shaft, g.devices, g.supply, g.start, g.heat);
  rig::BoardConfig board = c.board;
  board.bases = chip.bases;
  return {plant, chip.config, board, std::move(timeline), chip.later, c.wiring, c.probes};
}

}  // namespace sixstep::study
