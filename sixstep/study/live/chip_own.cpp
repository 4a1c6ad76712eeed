// SPDX-License-Identifier: Apache-2.0
#include "sixstep/study/live/chip_behind.hpp"

namespace sixstep::study::detail {

PairChip own_pair_chip(const Scenario& s, const Compiled& c) {
  return behind<rig::OwnDrive<control::BridgeCommand<double>>>(s, c);
}

LegChip own_leg_chip(const Scenario& s, const Compiled& c) {
  return behind<rig::OwnDrive<control::LegCommands<double>>>(s, c);
}

}  // namespace sixstep::study::detail
