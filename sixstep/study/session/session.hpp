// SPDX-License-Identifier: Apache-2.0
// A run that is lived: it goes on in slices, is looked at, changed, saved and taken up again, and in the end
// is a scenario that anybody can run again. What a bench with knobs, a co-simulation or a script stands on.
//
//   bits     however it is sliced and looked at, it has the bits of the uncut run: a slice ends behind an event
//   change   what [[at]] can say, at the next control tick. The session writes it into its scenario; what
//            cannot be so is refused as a file would be, and then nothing has changed
//   copy     a session is a value: a copy is a saved state, and goes on alone
//   replay   run(session.scenario()) has the digest of the session that was run to its end, or closed
#pragma once
#include <memory>

#include "sixstep/study/measure/present.hpp"
#include "sixstep/study/run/run.hpp"

namespace sixstep::study {

class Session {
 public:
  /// At t = 0, nothing done. Fixed point: its scaling, [control.full_scale], is that of the whole session.
  static base::Result<Session> open(const Scenario& scenario, const Listeners& listeners = {});

  Session(const Session& other);
  Session& operator=(const Session& other);
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;
  ~Session();

  /// Goes on to to_s, then up to the next event: now_s() may lie a little behind it, present() does not.
  /// False where the run is over: its end, a fault, or a listener that told it to stop.
  bool advance(double to_s);
  /// The same, and asks done(present()) once a PWM period: true ends it there.
  template <class Done>
  bool advance_until(double to_s, Done&& done);

  /// At the next control tick. `at.time_s` is not read: the instant is the answer, and stands in scenario().
  base::Result<double> change(At at);

  /// The instant asked for by the last advance; where the run stopped before it, or has not gone yet, now.
  const Present& present() const;
  double now_s() const;
  bool over() const;
  /// The scenario as it has become.
  const Scenario& scenario() const;

  /// What came out. A run that is not over ends at the next control tick: from then on that is its scenario's
  /// duration_s, and what lay behind it is dropped. Figures of a session whose reference was changed, or that
  /// ends early, have other windows than were known when it began: they are taken from a replay.
  base::Result<Outcome> close();

 private:
  struct State;
  explicit Session(std::unique_ptr<State> state);
  double period_s() const;

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
