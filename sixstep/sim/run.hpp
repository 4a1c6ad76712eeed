// SPDX-License-Identifier: Apache-2.0
// The run loop, on one page. Known instants are scheduled, only unknown ones are searched.
//
//   act on all that is due -> settle and expand (Taylor) -> first root of all guards -> end there -> observe -> advance -> apply ONE event
//
// A System provides
//   Instant now() const                    where it stands
//   Instant next_known() const             the next instant it has scheduled, > now once act() is done
//   bool act()                             does all that is due now, by its own clocks (never by what a step aimed at);
//                                          false where a fault stops the run
//   double expand(double h)                makes its discrete state consistent and its polynomials valid over the length
//                                          it returns, <= h; negative where no consistent state exists
//   void guards(Visit&&) const             calls visit(id, coefficients, degree, noise) for each guard that must stay
//                                          >= 0, those that snap a state first (they win a tie)
//   void end_at(Real s)                    the segment at hand ends at the fraction s of the expanded length
//   void advance(Real s, Instant to)       takes the state there
//   void apply(id)                         the one located event
// An Observer provides segment(system, s), called before the system advances over [0, s] of its expansion, and may
// provide done(): true ends the run after the event at hand.
#pragma once
#include <cstdint>

#include "sixstep/series/first_root.hpp"
#include "sixstep/sim/instant.hpp"

namespace sixstep::sim {

enum class Stop : std::uint8_t {
  end,         ///< the end was reached
  observer,    ///< the observer was done
  fault,       ///< act() refused
  unsettled,   ///< no consistent discrete state: a defect of the model
  no_progress  ///< more than a hundred events without time going on
};

struct Run {
  Stop stop = Stop::end;
  std::int64_t segments = 0;
};

struct NoObserver {
  template <class System, class Real>
  void segment(const System&, Real) {}
};

/// Zero-length steps are legal; a hundred without any progress of time are not (pitfall 7).
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
    if (!(length >= 0)) return {Stop::unsettled, result.segments};  // nor a length that is not a number

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
