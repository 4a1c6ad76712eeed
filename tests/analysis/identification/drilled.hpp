// SPDX-License-Identifier: Apache-2.0
// A log of Hall lines without disturbances, which identify() accepts.
#pragma once
#include "tests/analysis/identification/drawn_hall_log.hpp"

namespace sixstep::testing {

/// A drill turns the motor by six electrical turns. The log has forty rows per sector.
inline HallTruth drilled() {
  HallTruth t;
  t.turning = Turning::drill;
  t.turns = 6.0;
  t.usual_turns_s = 10.0;
  t.row_s = 1.0 / (10.0 * 6.0 * 40.0);
  t.jitter_deg = 0.05;
  return t;
}

}  // namespace sixstep::testing
