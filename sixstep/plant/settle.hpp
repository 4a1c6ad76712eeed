// SPDX-License-Identifier: Apache-2.0 settle() finds the consistent mode. Switches and nonzero currents
// determine most connections. settle() tries all combinations of three undetermined parts: legs without gate
// and current, the rotor at rest, and the bus at the source's voltage. Exactly one combination is consistent.
// If several appear consistent because of rounding, settle() selects the combination with most legs off
// (model.md 2, 4b). It checks the values at the instant first, and the series only for ties.
#pragma once
#include <span>

#include "sixstep/plant/settle_fast.hpp"
#include "sixstep/series/first_root.hpp"

namespace sixstep::plant {

namespace detail {

enum class Judgement : std::uint8_t { holds, fails, tie };

template <class Real>
constexpr Judgement judge(Real margin, Real noise) {
  return margin > noise ? Judgement::holds : margin < -noise ? Judgement::fails : Judgement::tie;
}

constexpr Judgement both(Judgement a, Judgement b) {
  if (a == Judgement::fails || b == Judgement::fails) return Judgement::fails;
  return a == Judgement::tie || b == Judgement::tie ? Judgement::tie : Judgement::holds;
}

template <class Real>
PerLeg<Real> back_emf(const Constants<Real>& c, const State<Real>& s, const Mode& m) {
  const EmfPiece<Real>& p = c.emf[m.sector].piece[m.piece];
  Real phi0, phi1;
  shape_at(c, s, phi0, phi1);
  PerLeg<Real> e;
  for (int k = 0; k < 3; ++k) e[k] = s.w * (p.alpha[k] * phi0 + p.beta[k] * phi1);
  return e;
}

/// Electromagnetic torque, N m: K_e sum f_k i_k (model.md (3)). It is computed as the back-EMF e at the speed
/// 1, so that it is exact at standstill too.
template <class Real>
Real torque(const Constants<Real>& c, const State<Real>& s, const Mode& m) {
  State<Real> unit = s;
  unit.w = 1;
  const PerLeg<Real> f = back_emf(c, unit, m);
  return f[0] * s.i[0] + f[1] * s.i[1] + f[2] * s.i[2];
}

/// Checks the legs by the values at the instant. The voltages of floating legs must be within the rails. In a
/// leg whose diode begins to conduct, the voltage must drive a current in the diode's direction.
template <class Real>
Judgement judge_legs(const Constants<Real>& c, const State<Real>& s, const PerLeg<Real>& e, const Mode& m,
                     Real slack) {
  const Real noise = c.volt_noise * slack, V_f = Real(c.devices.V_f_V);
  const Real u_n = star_voltage(m.legs, c.poles, s.bus, s.i, e);
  Judgement all = Judgement::holds;
  for (int k = 0; k < 3; ++k) {
    if (is_floating(m.legs[k])) {
      const Real free = u_n + e[k];
      // mutant: free + V_f => free
      all = both(all, both(judge(free + V_f, noise), judge(s.bus + V_f - free, noise)));
    } else if (is_diode(m.legs[k]) && s.i[k] == 0) {
      const Real u = pole_voltage(c.poles[static_cast<std::size_t>(m.legs[k])], s.bus, s.i[k]);
      all = both(all, judge(along_diode(m.legs[k], u - u_n - e[k]), noise));  // L di/dt
    }
  }
  return all;
}

template <class Real>
Judgement judge_motion(const Constants<Real>& c, const State<Real>& s, const Mode& m, Real slack) {
  if (!c.dry_friction || s.w != 0 || m.motion == Motion::locked) return Judgement::holds;
  const auto [load, dry, per_speed] = torques(c, Motion::stuck);  // the rotor is at rest: B w is 0, and
                                                                  // c.breakaway replaces `dry`
  const Real noise = c.torque_noise * slack, excess = torque(c, s, m) - load;
  if (m.motion == Motion::stuck) return judge(c.breakaway - abs(excess), noise);
  // To start, a rotor must overcome the breakaway torque. If this torque is above the sliding friction, a
  // rotor between the two values is consistent only at rest.
  const Real push = m.motion == Motion::forward ? excess : -excess;
  return judge(push - c.breakaway, noise);
}

template <class Real>
Judgement judge_source(const Constants<Real>& c, const State<Real>& s, const Mode& m, Real slack) {
  if (c.source_sinks) return Judgement::holds;
  const Real noise = c.volt_noise * slack, above = s.bus - c.V_0;
  return judge(m.source_feeds ? -above : above, noise);
}

/// Checks the leading term of each guard: no guard of the mode may become negative at the segment's start.
template <class Real>
bool holds_in_series(const Constants<Real>& c, const Mode& m, const Expansion<Real>& y, Real slack) {
  bool ok = true;
  mode_guards(c, m, y, slack, [&](int, const series::Coefficients<Real>& g, int degree, Real noise) {
    // mutant: series::leading(g, degree, noise).sign >= 0 => series::leading(g, degree, noise).sign > 0
    ok = ok && series::leading(g, degree, noise).sign >= 0;
  });
  return ok;
}

/// A combination of up to three undetermined legs that float or conduct by a diode. The tables contain all
/// combinations for one, two and three such legs, with the fewest conducting legs first.
struct Combination {
  std::array<Connection, 3> leg{};
  std::uint8_t on = 0;
};
inline constexpr std::array<Connection, 3> choices = {Connection::floating, Connection::low_diode,
                                                      Connection::high_diode};

template <int legs>
constexpr auto combinations() {
  constexpr std::size_t count = legs == 1 ? 3 : legs == 2 ? 9 : 27;
  std::array<Combination, count> all{};
  std::size_t n = 0;
  for (int on = 0; on <= legs; ++on)
    for (std::size_t code = 0; code < count; ++code) {
      Combination c;
      for (std::size_t k = 0, rest = code; k < legs; ++k, rest /= 3) {
        c.leg[k] = choices[rest % 3];
        c.on = static_cast<std::uint8_t>(c.on + (rest % 3 != 0));
      }
      if (c.on == on) all[n++] = c;
    }
  return all;
}
inline constexpr auto of_one = combinations<1>();
inline constexpr auto of_two = combinations<2>();
inline constexpr auto of_three = combinations<3>();

constexpr std::span<const Combination> combinations_of(int legs) {
  static_assert(of_three.back().on == 3);
  if (legs == 1) return of_one;
  if (legs == 2) return of_two;
  return of_three;
}

}  // namespace detail

/// Input of settle(). `state` must have been processed by snap().
template <class Real>
struct Question {
  const Constants<Real>& constants;
  const State<Real>& state;
  const Gates& gates;
  Real h;            ///< length over which series are checked, s
  bool series_only;  ///< true: after an event without progress, because the check of the values at the
                     ///< instant was wrong
  Real slack = 1;
};

namespace detail {

template <class Real>
bool accepts(const Question<Real>& q, const PerLeg<Real>& emf, const Mode& mode, Expansion<Real>& scratch,
             bool& expanded) {
  const Judgement plain = both(judge_legs(q.constants, q.state, emf, mode, q.slack),
                               both(judge_motion(q.constants, q.state, mode, q.slack),
                                    judge_source(q.constants, q.state, mode, q.slack)));
  expanded = false;
  if (plain == Judgement::fails) return false;
  // mutant: !q.series_only => true
  if (plain == Judgement::holds && !q.series_only) return true;
  expand(q.constants, q.state, mode, q.h, scratch);
  expanded = true;
  return holds_in_series(q.constants, mode, scratch, q.slack);
}

/// Tries all combinations of the open legs, with the fewest conducting legs first.
template <class Real>
bool settle_by_trial(const Question<Real>& q, const PerLeg<Real>& emf, unsigned open, Mode& mode,
                     Expansion<Real>& scratch, bool& expanded) {
  std::array<unsigned, 3> undecided{};
  int count = 0;
  for (unsigned k = 0; k < 3; ++k)
    if (open >> k & 1) undecided[count++] = k;
  for (const Combination& tried : combinations_of(count)) {
    for (int u = 0; u < count; ++u) mode.legs[undecided[u]] = tried.leg[u];
    if (tried.on == 1 && connected_count(mode.legs) == 1) continue;  // a single leg conducts no current
    if (accepts(q, emf, mode, scratch, expanded)) return true;
  }
  return false;
}

template <class Real>
bool settle_legs(const Question<Real>& q, Mode& mode, Expansion<Real>& scratch, bool& expanded) {
  const unsigned open = named_legs(q.state, q.gates, Real(0), mode.legs);
  const PerLeg<Real> emf = back_emf(q.constants, q.state, mode);
  if (open == 0) return accepts(q, emf, mode, scratch, expanded);
  return settle_by_trial(q, emf, open, mode, scratch, expanded);
}

template <class Real>
bool settle_source(const Question<Real>& q, Mode& mode, Expansion<Real>& scratch, bool& expanded) {
  if (q.constants.source_sinks) {
    mode.source_feeds = true;
    return settle_legs(q, mode, scratch, expanded);
  }
  for (const bool feeds : {false, true}) {
    mode.source_feeds = feeds;
    if (settle_legs(q, mode, scratch, expanded)) return true;
  }
  return false;
}

}  // namespace detail

/// Finds the consistent mode and writes it to `mode`. Sets `expanded` to true if `scratch` contains the
/// mode's expansion over q.h. Returns false if no mode is consistent at this rounding level.
template <class Real>
bool settle(const Question<Real>& q, Mode& mode, Expansion<Real>& scratch, bool& expanded) {
  using enum Motion;
  expanded = false;
  const Constants<Real>& c = q.constants;
  if (c.locked || !c.dry_friction || q.state.w != 0) {
    mode.motion = c.locked ? locked : !c.dry_friction ? free : motion_at(q.state.w);
    return detail::settle_source(q, mode, scratch, expanded);
  }
  for (const Motion motion : {stuck, forward, backward}) {
    mode.motion = motion;
    if (detail::settle_source(q, mode, scratch, expanded)) return true;
  }
  return false;
}

}  // namespace sixstep::plant
