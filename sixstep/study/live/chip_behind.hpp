// SPDX-License-Identifier: Apache-2.0
// A firmware's chip behind the interface of any_drive.hpp. Included only by the files named chip_*.
#pragma once
#include "sixstep/control/fixed.hpp"
#include "sixstep/rig/drive_of.hpp"
#include "sixstep/study/compile/chip.hpp"
#include "sixstep/study/live/chips.hpp"

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
  switch (s.control.arithmetic) {
    case Arithmetic::float64:
      return behind<Firmware<double>>(s, c);
    case Arithmetic::float32:
      return behind<Firmware<float>>(s, c);
    case Arithmetic::q15:
      return behind<Firmware<control::Q15>>(s, c);
    case Arithmetic::q14:
      return behind<Firmware<control::Q14>>(s, c);
    case Arithmetic::q31:
      return behind<Firmware<control::Q31>>(s, c);
    case Arithmetic::q30:
      return behind<Firmware<control::Q30>>(s, c);
  }
  return base::Problem{"control.arithmetic", "", "is none that there is", "see control.arithmetic"};
}

}  // namespace sixstep::study::detail
