// SPDX-License-Identifier: Apache-2.0
// One leg's output of the timer, with its dead time (model.md 11). When the leg's command changes, the switch
// that was on turns off at once, and the other switch turns on no earlier than the dead time after the
// change. A further change within the dead time cancels this turn-on. A command that repeats the present
// command has no dead time.
#pragma once
#include "sixstep/control/leg_command.hpp"
#include "sixstep/sim/instant.hpp"

namespace sixstep::rig {

using control::LegSide;

class LegChannel {
 public:
  LegChannel() = default;
  /// A leg that has had this command so long that no switch waits.
  explicit LegChannel(LegSide side) : side_(side) {}

  /// Sets a command different from the present command. The dead time counts from the command that turns a
  /// switch off, even if that switch was still waiting and not yet on. After a gap shorter than the dead time
  /// the upper switch therefore waits for a whole dead time.
  void tell(const sim::Instant& t, LegSide side, double dead_ticks) {
    // mutant: side_ == LegSide::high => side_ != LegSide::high
    if (side_ != LegSide::none) (side_ == LegSide::high ? low_from_ : high_from_) = t.plus_ticks(dead_ticks);
    side_ = side;
    // mutant: t < from() => false
    waits_ = side != LegSide::none && t < from();
  }
  /// Makes any switch of the leg that turns on wait for a dead time from t, because the leg's previous state
  /// is unknown.
  void hold(const sim::Instant& t, double dead_ticks) { low_from_ = high_from_ = t.plus_ticks(dead_ticks); }
  /// Makes the switch that is to turn on wait for a dead time from t, as if its command came at t.
  void delay(const sim::Instant& t, double dead_ticks) {
    if (side_ == LegSide::none || waits_) return;
    hold(t, dead_ticks);
    waits_ = t < from();
  }
  /// Ends the wait if its end is reached.
  void look(const sim::Instant& t) { waits_ = waits_ && t < from(); }

  bool waits() const { return waits_; }
  /// End of the wait: from then on the commanded switch may be on.
  const sim::Instant& from() const { return side_ == LegSide::high ? high_from_ : low_from_; }

 private:
  sim::Instant low_from_{}, high_from_{};  ///< the switch turns on no earlier than this instant
  LegSide side_ = LegSide::none;
  bool waits_ = false;
};

}  // namespace sixstep::rig
