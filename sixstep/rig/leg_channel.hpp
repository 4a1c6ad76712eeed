// SPDX-License-Identifier: Apache-2.0
// One leg's output of the timer, with its dead time (model.md 11): at each change of the leg's command the
// switch that was on is off at once, and the other one comes on no earlier than the dead time after that
// command. A new change before that cancels it. No change, no dead time.
#pragma once
#include "sixstep/control/leg_command.hpp"
#include "sixstep/sim/instant.hpp"

namespace sixstep::rig {

using control::LegSide;

class LegChannel {
 public:
  LegChannel() = default;
  /// One that has been told this long ago.
  explicit LegChannel(LegSide side) : side_(side) {}

  /// Another command than before. The turn-off command counts, not whether that switch had come on: after a gap
  /// shorter than the dead time the upper switch waits for the whole of it.
  void tell(const sim::Instant& t, LegSide side, double dead_ticks) {
    // mutant: side_ == LegSide::high => side_ != LegSide::high
    if (side_ != LegSide::none) (side_ == LegSide::high ? low_from_ : high_from_) = t.plus_ticks(dead_ticks);
    side_ = side;
    // mutant: t < from() => false
    waits_ = side != LegSide::none && t < from();
  }
  /// Nobody knows what the leg did before: whatever turns on waits.
  void hold(const sim::Instant& t, double dead_ticks) { low_from_ = high_from_ = t.plus_ticks(dead_ticks); }
  /// The switch that is on comes on later, as if it were told only now.
  void delay(const sim::Instant& t, double dead_ticks) {
    if (side_ == LegSide::none || waits_) return;
    hold(t, dead_ticks);
    waits_ = t < from();
  }
  /// The wait may be over.
  void look(const sim::Instant& t) { waits_ = waits_ && t < from(); }

  bool waits() const { return waits_; }
  /// When the wait is over.
  const sim::Instant& from() const { return side_ == LegSide::high ? high_from_ : low_from_; }

 private:
  sim::Instant low_from_{}, high_from_{};  ///< no earlier than this may the switch come on
  LegSide side_ = LegSide::none;
  bool waits_ = false;
};

}  // namespace sixstep::rig
