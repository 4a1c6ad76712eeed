// SPDX-License-Identifier: Apache-2.0
// The run loop. Instants that are known in advance are scheduled. The loop searches only for instants that
// depend on the state.
//
//   act on all that is due -> settle and expand (Taylor) -> first root of all guards -> end there -> observe -> advance -> apply ONE event
//
// A System provides
//   Instant now() const                    the present instant
//   Instant next_known() const             the next scheduled instant, > now after act()
//   bool act()                             executes all actions that are due at now(), never at the planned end
//                                          of a step; false if a fault stops the run
//   double expand(double h)                makes the discrete state consistent and the polynomials valid over the
//                                          returned length, <= h; negative if no consistent state exists
//   void guards(Visit&&) const             calls visit(id, coefficients, degree, noise) for each guard that must stay
//                                          >= 0; guards whose event sets a state exactly come first: of several
//                                          guards at one instant the first is applied
//   void end_at(Real s)                    ends the segment at the fraction s of the expanded length
//   void advance(Real s, Instant to)       advances the state to the segment's end, at the instant `to`
//   void apply(id)                         applies the located event
// An Observer provides segment(system, s), which is called before the system advances over [0, s] of its
// expansion. An Observer may also provide done(): if done() is true, the run ends after the present event.
#pragma once
#include <cstdint>

#include "sixstep/series/first_root.hpp"
#include "sixstep/sim/instant.hpp"

namespace sixstep::sim {

enum class Stop : std::uint8_t {
  end,         ///< the end was reached
  observer,    ///< the observer's done() returned true
  fault,       ///< act() returned false
  unsettled,   ///< the model has no consistent discrete state
  no_progress  ///< more than a hundred events without progress of time
};

struct Run {
  Stop stop = Stop::end;
  std::int64_t segments = 0;
};

struct NoObserver {
  template <class System, class Real>
  void segment(const System&, Real) {}
};

/// Largest number of successive steps without progress of time. A longer sequence
/// of steps of zero length stops the run (architecture.md, pitfall 7).
inline constexpr int stalled_limit = 100;

template <class System, class Observer>
Run run(System& system, Instant end, Observer& observer) {
  using Real = typename System::Real;
  Run result;
  int stalled = 0;
  for (;;) {
    if (!system.act()) return {Stop::fault, result.segments};
    const Instant now = system.now();
    if (!(now < end)) return result;

    const Instant next = system.next_known();
    const Instant known = next < end ? next : end;
    const double wanted = seconds_between(now, known);
    const double length = system.expand(wanted);
    if (!(length >= 0)) return {Stop::unsettled, result.segments};  // true also if the length is NaN

    Real first = 1;
    int event = -1;
    system.guards([&](int id, const series::Coefficients<Real>& c, int degree, Real noise) {
      if (const Real root = series::first_root(c, degree, first, noise);
          // mutant: event < 0 && root == first => root == first
          root < first || (event < 0 && root == first)) {
        first = root;
        event = id;
      }
    });

    system.end_at(first);
    // mutant: first => Real(1)
    observer.segment(system, first);
    // mutant: event < 0 && length == wanted => event < 0
    const bool reached = event < 0 && length == wanted;
    const Instant to =
        reached ? known : now.plus_seconds(static_cast<double>(first * static_cast<Real>(length)));
    system.advance(first, to);
    if (event >= 0) system.apply(event);
    ++result.segments;
    if constexpr (requires { observer.done(system); })
      if (observer.done(system)) return {Stop::observer, result.segments};
    stalled = now < to ? 0 : stalled + 1;
    // mutant: stalled > stalled_limit => stalled >= stalled_limit
    if (stalled > stalled_limit) return {Stop::no_progress, result.segments};
  }
}

}  // namespace sixstep::sim
