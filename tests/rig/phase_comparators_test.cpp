// SPDX-License-Identifier: Apache-2.0
// With hard chopping, each driven phase has a comparator. If two legs conduct, i_p = -i_n, so both currents
// reach their level at the same instant. Rounding must not decide whether the second comparator also
// switches.
#include <gtest/gtest.h>

#include "tests/support/board.hpp"

namespace SIXSTEP_TEST_FILE {

using namespace sixstep;
using namespace sixstep::testing;
using control::Chopping;

/// Counts the states that follow after both gates of the pair were on: both gates off, only the source's gate
/// off, or only the sink's gate off.
struct FirstStates {
  bool both_on = false;
  int both_off = 0, source_off = 0, sink_off = 0;
  template <class Rig>
  void segment(const Rig& rig, typename Rig::Real s) {
    if (!(s > 0)) return;
    const bool high = rig.plant().gates().high[0], low = rig.plant().gates().low[1];
    if (both_on) {
      both_off += !high && !low;
      source_off += !high && low;
      sink_off += high && !low;
    }
    both_on = high && low;
  }
};

FirstStates watched(double reference) {
  Board b = Board::hysteresis(reference, 0.25, Chopping::hard);
  b.drive.hysteresis.watch = control::Watch::phase;
  b.shaft.locked = true;
  b.start.angle_rad = 0.02;
  auto rig = b.rig();
  FirstStates states;
  EXPECT_EQ(run_to(rig, 5e-3, states), sim::Stop::end);
  return states;
}

TEST(PhaseComparators, BothSwitchWhereBothReachTheirLevel) {
  for (const double reference : {3.0, 5.0, 5.1, 7.3, 9.9}) {
    const FirstStates states = watched(reference);
    EXPECT_GT(states.both_off, 10) << reference;
    EXPECT_EQ(states.source_off, 0) << reference << ": the other comparator saw the same current";
    EXPECT_EQ(states.sink_off, 0) << reference;
  }
}

}  // namespace SIXSTEP_TEST_FILE
