// SPDX-License-Identifier: Apache-2.0
// What a run shows of one instant.
#pragma once
#include "sixstep/study/measure/columns.hpp"
#include "sixstep/study/measure/logic.hpp"

namespace sixstep::study {

/// One instant: each signal in the order of all_columns(), whether it applies or not, and of logic_signals().
struct Present {
  double t_s = 0.0;
  FullRow signals{};
  LogicRow logic{};
  control::Mode mode = control::Mode::off;
};

}  // namespace sixstep::study
