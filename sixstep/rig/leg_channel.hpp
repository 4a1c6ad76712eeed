// SPDX-License-Identifier: Apache-2.0
// One leg's output of the timer, with dead time (model.md 11). When the leg's command changes, the switch
// that is on turns off at once. The opposite switch turns on after the dead time at the earliest. A further
// change within the dead time cancels this turn-on. A command that repeats the present command has no dead
// time.
#pragma once
#include "sixstep/control/leg_command.hpp"
#include "sixstep/sim/instant.hpp"

namespace sixstep::rig {

using control::LegSide;

class LegChannel {
 public:
  LegChannel() = default;
  /// A leg that has had the command `side` longer than the dead time, so that no switch waits.
  explicit LegChannel(LegSide side) : side_(side) {}

  /// Sets a command different from the present command. The dead time begins with the command that turns a
  /// switch off, even if this switch was still waiting. After a gap shorter than the dead time, the upper
  /// switch therefore waits for a whole dead time.
  void tell(const sim::Instant& t, LegSide side, double dead_ticks) {
    // mutant: side_ == LegSide::high => side_ != LegSide::high
    if (side_ != LegSide::none) (side_ == LegSide::high ? low_from_ : high_from_) = t.plus_ticks(dead_ticks);
    side_ = side;
    // mutant: t < from() => false
    waits_ = side != LegSide::none && t < from();
  }
  /// Both switches of the leg must wait for a dead time from t, because the leg's previous state is unknown.
  void hold(const sim::Instant& t, double dead_ticks) { low_from_ = high_from_ = t.plus_ticks(dead_ticks); }
  /// The commanded switch must wait for a dead time from t, as if it had been commanded at t.
  void delay(const sim::Instant& t, double dead_ticks) {
    if (side_ == LegSide::none || waits_) return;
    hold(t, dead_ticks);
    waits_ = t < from();
  }
  /// Ends the wait if t is not before from().
  void look(const sim::Instant& t) { waits_ = waits_ && t < from(); }

  bool waits() const { return waits_; }
  /// End of the wait: the earliest instant at which the commanded switch may be on.
  const sim::Instant& from() const { return side_ == LegSide::high ? high_from_ : low_from_; }

 private:
  sim::Instant low_from_{}, high_from_{};  ///< earliest instants at which the lower, the upper switch may
                                           ///< turn on
  LegSide side_ = LegSide::none;
  bool waits_ = false;
};

}  // namespace sixstep::rig
