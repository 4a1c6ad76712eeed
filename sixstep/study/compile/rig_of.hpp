// SPDX-License-Identifier: Apache-2.0
// Builds the rig of a run, which sim::run advances, from motor, bridge, chip and timeline.
#pragma once
#include "sixstep/plant/general/plant.hpp"
#include "sixstep/rig/rig.hpp"
#include "sixstep/study/compile/compile.hpp"

namespace sixstep::study {

/// A firmware's configuration in the chip's arithmetic.
template <class Firmware>
struct Chip {
  typename Firmware::Config config;
  rig::Bases bases;
  std::vector<rig::Tuning<typename Firmware::Config>> later;  ///< configurations for the retune actions
  FullScale full_scale{};                                     ///< fixed point: full scale of the whole run
};

template <class Firmware>
rig::Rig<double, Firmware> rig_of(const Compiled& c, const Chip<Firmware>& chip, rig::Timeline timeline) {
  const plant::Plant<double> plant(c.motor.machine, c.shaft, c.devices, c.supply, c.start);
  rig::BoardConfig board = c.board;
  board.bases = chip.bases;
  return {plant, chip.config, board, std::move(timeline), chip.later};
}

/// The rig of a scenario that the general kernel runs.
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
