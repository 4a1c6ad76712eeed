// SPDX-License-Identifier: Apache-2.0
// Checks the gates of each leg. A switch may turn on only if the dead time has passed since the turn-off of
// the other switch. At the first turn-on, the dead time counts from the start of the run.
#pragma once
#include <gtest/gtest.h>

#include <array>

#include "sixstep/plant/state.hpp"
#include "sixstep/sim/instant.hpp"

namespace sixstep::testing {

class DeadTimeWatch {
 public:
  explicit DeadTimeWatch(double dead_s) : dead_s_(dead_s * (1 - 0x1p-50)) {}

  void look(const plant::Gates& gates, const sim::Instant& now) {
    for (unsigned k = 0; k < 3; ++k) look(legs_[k], gates.high[k], gates.low[k], now);
  }
  int turn_ons() const { return turn_ons_; }

 private:
  struct Leg {
    sim::Instant high_off{}, low_off{};
    bool was_high = false, was_low = false;
  };
  void look(Leg& leg, bool high, bool low, const sim::Instant& now) {
    if (high && !leg.was_high) turned_on(leg.low_off, now);
    if (low && !leg.was_low) turned_on(leg.high_off, now);
    if (!high && leg.was_high) leg.high_off = now;
    if (!low && leg.was_low) leg.low_off = now;
    leg.was_high = high;
    leg.was_low = low;
  }
  void turned_on(const sim::Instant& other_off, const sim::Instant& now) {
    ++turn_ons_;
    EXPECT_GE(sim::seconds_between(other_off, now), dead_s_) << "at " << now.seconds() << " s";
  }

  double dead_s_;
  int turn_ons_ = 0;
  std::array<Leg, 3> legs_{};
};

}  // namespace sixstep::testing
