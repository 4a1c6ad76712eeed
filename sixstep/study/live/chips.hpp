// SPDX-License-Identifier: Apache-2.0
// The chips that a rig can have. Each firmware is compiled in each arithmetic, separately from the kernels,
// in the file chip_* with its name.
#pragma once
#include "sixstep/rig/any_drive.hpp"
#include "sixstep/study/compile/rig_of.hpp"

namespace sixstep::study::detail {

using PairChip = base::Result<Chip<rig::PairDrive>>;
using LegChip = base::Result<Chip<rig::LegDrive>>;

// The chip of the scenario. Problems: the drive's numbers do not fit into the arithmetic.
PairChip sensed_chip(const Scenario& scenario, const Compiled& compiled);
PairChip product_chip(const Scenario& scenario, const Compiled& compiled);
PairChip sensorless_chip(const Scenario& scenario, const Compiled& compiled);
LegChip field_chip(const Scenario& scenario, const Compiled& compiled);
PairChip own_pair_chip(const Scenario& scenario, const Compiled& compiled);
LegChip own_leg_chip(const Scenario& scenario, const Compiled& compiled);

}  // namespace sixstep::study::detail
