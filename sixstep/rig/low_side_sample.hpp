// SPDX-License-Identifier: Apache-2.0
// What a sample of low-side shunts means, by the command in effect.
#pragma once
#include <cstdint>

#include "sixstep/control/low_side.hpp"

namespace sixstep::rig {

struct BoardCommand;

struct LowSideSample {
  bool on = false;         ///< the bridge is on
  bool by_pair = false;    ///< the command drives a pair; if not, three legs
  std::uint8_t shown = 0;  ///< legs whose sample counts (control/low_side.hpp)
  control::Pair pair{};
};

LowSideSample low_side_sample(const control::LowSideConfig<double>& config, const BoardCommand& command);
LowSideSample low_side_sample(const control::LowSideConfig<double>& config,
                              const control::LegCommands<double>& command);

}  // namespace sixstep::rig
