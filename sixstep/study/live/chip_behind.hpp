// SPDX-License-Identifier: Apache-2.0
// Functions that create the chip of a firmware; the rig calls the chip through any_drive.hpp. Only the files
// chip_*.cpp include this header.
#pragma once
#include "sixstep/rig/drive_of.hpp"
#include "sixstep/study/compile/chip.hpp"
#include "sixstep/study/live/chips.hpp"
#include "sixstep/study/scenario/in_arithmetic.hpp"

namespace sixstep::study::detail {

template <class Firmware>
using AnyChip = Chip<rig::AnyDrive<rig::SiCommand<Firmware>>>;

template <class Firmware>
base::Result<AnyChip<Firmware>> behind(const Scenario& s, const Compiled& c) {
  const base::Result<Chip<Firmware>> chip = chip_of<Firmware>(s, c);
  if (!chip) return chip.problems();
  const auto hidden = [&](const typename Firmware::Config& config) {
    return std::make_shared<const rig::ConfigOf<Firmware>>(config, chip->bases);
  };
  AnyChip<Firmware> out{hidden(chip->config), {.setpoint = chip->bases.setpoint}, {}, chip->full_scale};
  for (const auto& tuning : chip->later) out.later.push_back({hidden(tuning.config), tuning.setpoint_unit});
  return out;
}

template <template <class> class Firmware>
auto in_each_arithmetic(const Scenario& s, const Compiled& c) -> base::Result<AnyChip<Firmware<double>>> {
  return in_arithmetic(s.control.arithmetic, [&]<class Scalar>() -> base::Result<AnyChip<Firmware<double>>> {
    return behind<Firmware<Scalar>>(s, c);
  });
}

}  // namespace sixstep::study::detail
