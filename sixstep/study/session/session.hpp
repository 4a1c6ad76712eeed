// SPDX-License-Identifier: Apache-2.0
// A run in slices. It can be advanced, read, changed, saved and resumed, and ends as a scenario that can be
// run again. Test benches with knobs, co-simulations and scripts are built on it.
// - Bits: slices and reads do not change a bit of the run, because a slice ends after an event.
// - Change: everything that [[at]] can change, at the next control tick. The session adds the change to its
//   scenario. An invalid change is refused like an invalid file, and then nothing has changed.
// - Copy: a session is a value. A copy is a saved state, and continues independently.
// - Replay: run(session.scenario()) has the digest of the session, if the session ran to its end or was
// closed.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>

#include "sixstep/study/measure/present.hpp"
#include "sixstep/study/run/run.hpp"

namespace sixstep::study {

class Session {
 public:
  /// Opens a session at t = 0. In fixed point, the scaling [control.full_scale] applies to the whole session.
  /// `instead` is a chip that sets the gates instead of the drive; copies of the session share it.
  static base::Result<Session> open(const Scenario& scenario, const Listeners& listeners = {},
                                    const rig::ChipPort& instead = {});

  Session(const Session& other);
  Session& operator=(const Session& other);
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;
  ~Session();

  /// Advances to to_s in seconds, and then up to the next event. now_s() may therefore lie a little after
  /// to_s; present() does not. Returns false if the run is over: it reached its end, or a fault or a listener
  /// stopped it.
  bool advance(double to_s);
  /// Advances like advance() without reading: present() keeps its values. Reading costs as much as one or two
  /// PWM periods. A later advance() to an instant before now_s() reads the values of now_s().
  bool skip(double to_s);
  /// Advances like advance(), and calls done(present()) once per PWM period. If done() returns true, the
  /// advance ends.
  template <class Done>
  bool advance_until(double to_s, Done&& done);

  /// Advances to the next control tick after the present instant and reads it. The controller has not yet
  /// acted at this tick. Returns false like advance().
  bool advance_to_tick();
  /// Advances to the next instant at which the code at the Hall pins changes, but at most to to_s. Changes by
  /// delays, glitches and broken lines count. Returns false like advance().
  bool advance_to_hall_edge(double to_s);
  /// True if the present instant is a control tick on which the controller has not yet acted.
  bool at_tick() const;
  /// Instant of the first control tick after an instant.
  double tick_after_s(double at_s) const;
  /// Calls the controller with the measurement of the present instant, in a copy of its state: the session is
  /// unchanged. The session must be at_tick().
  void call_controller() const;

  /// Changes values at the next control tick. Returns the time of this tick in s, which scenario() contains
  /// too. `at.time_s` is not read.
  base::Result<double> change(At at);

  /// Values at the instant of the last advance. If the run stopped before that instant, or has not begun:
  /// values at the present instant.
  const Present& present() const;
  double now_s() const;
  bool over() const;
  /// The scenario with all changes so far.
  const Scenario& scenario() const;
  /// The board that the scenario was compiled to.
  const rig::BoardConfig& board() const;

  /// Ends the session and returns the results. A run that is not over ends at the next control tick. The time
  /// of this tick becomes the scenario's duration_s, and later events are dropped. If the reference was
  /// changed or the session ends early, the figures' windows have changed since the beginning. The figures
  /// are then taken from a replay. Without `replay`, the outcome contains no such figures: for a controller
  /// that is not part of the scenario.
  base::Result<Outcome> close(bool replay = true);

 private:
  struct State;
  explicit Session(std::unique_ptr<State> state);
  double period_s() const;
  bool go(const sim::Instant& asked, bool read, std::optional<std::uint8_t> pins = {});

  std::unique_ptr<State> state_;
};

template <class Done>
bool Session::advance_until(double to_s, Done&& done) {
  const double period = period_s();
  while (present().t_s < to_s) {
    const double next = present().t_s + period;
    if (!advance(next < to_s ? next : to_s)) return false;
    if (done(present())) break;
  }
  return !over();
}

}  // namespace sixstep::study
