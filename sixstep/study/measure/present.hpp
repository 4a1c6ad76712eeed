// SPDX-License-Identifier: Apache-2.0
// The values of a run at one instant.
#pragma once
#include "sixstep/study/measure/columns.hpp"
#include "sixstep/study/measure/logic.hpp"

namespace sixstep::study {

/// All columns in the order of all_columns(), whether they apply or not, and all signals of logic_signals().
struct Present {
  double t_s = 0.0;
  FullRow signals{};
  LogicRow logic{};
  control::Mode mode = control::Mode::off;
};

}  // namespace sixstep::study
