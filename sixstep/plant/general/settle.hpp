// SPDX-License-Identifier: Apache-2.0 settle() finds the general plant's consistent mode (plant/settle.hpp).
// Gates and currents determine a part of the mode. settle() tries the possible values of the other parts:
// legs without current (fewest conducting legs first), a rotor at rest, and a source at its limit. It checks
// the values at the instant first, and expands the series only for a tie.
#pragma once
#include "sixstep/plant/general/guards.hpp"
#include "sixstep/plant/settle.hpp"

namespace sixstep::plant::general {

template <class Real>
struct Question {
  const Constants<Real>& constants;
  const State<Real>& state;
  const More<Real>& more;
  const Gates& gates;
  unsigned dead = 0, breaking = 0;
  Real h = 0;
  bool series_only = false;
  Real slack = 1;
};

namespace detail {

using plant::detail::both;
using plant::detail::judge;
using plant::detail::Judgement;

/// Writes the connections that gates and currents determine. Returns a mask of the other legs, which are
/// called open.
template <class Real>
unsigned named_legs(const Question<Real>& q, Legs& legs) {
  unsigned open = 0;
  for (unsigned k = 0; k < 3; ++k) {
    const Real i = q.state.i[k];
    const bool high = q.gates.high[k], low = q.gates.low[k];
    legs[k] = Connection::floating;
    if ((q.dead >> k & 1) != 0) continue;
    if (!q.constants.devices.igbt && (high || low)) {
      legs[k] = high ? Connection::high_switch : Connection::low_switch;
      continue;
    }
    const LegConnections ways = ways_of(q.constants.devices, high, low);
    if (i > 0)
      legs[k] = ways.positive;
    else if (i < 0)
      legs[k] = ways.negative;
    else
      open |= 1U << k;
  }
  return open;
}

/// Checks the legs by the values at the instant. expand_first() must have written these values to y and z.
template <class Real>
Judgement judge_legs(const Question<Real>& q, const Mode& mode, const Expansion<Real>& y,
                     const Series<Real>& z) {
  const Constants<Real>& c = q.constants;
  const Real noise = c.volt_noise * q.slack;
  const auto at = [&](unsigned k, Connection to) {
    const PoleTerms<Real>& terms = c.terms(k, to);
    return terms.bus_share * y.bus[0] + terms.offset_V;
  };
  PerLeg<Real> up{}, down{};  // voltages at which leg k would begin to conduct a negative and a positive
                              // current
  for (unsigned k = 0; k < 3; ++k) {
    const LegConnections ways = ways_of(c.devices, q.gates.high[k], q.gates.low[k]);
    up[k] = at(k, ways.negative);
    down[k] = at(k, ways.positive);
  }
  Judgement all = Judgement::holds;
  if (connected_count(mode.legs) == 0) {
    for (unsigned j = 0; j < 3; ++j)
      for (unsigned k = 0; k < 3; ++k)
        if (j != k && (q.dead >> j & 1) == 0 && (q.dead >> k & 1) == 0)
          all = both(all, judge(up[j] - down[k] - (z.pole[j][0] - z.pole[k][0]), noise));
    return all;
  }
  for (unsigned k = 0; k < 3; ++k) {
    if ((q.dead >> k & 1) != 0) continue;
    if (is_floating(mode.legs[k])) {
      all = both(all, both(judge(z.pole[k][0] - down[k], noise), judge(up[k] - z.pole[k][0], noise)));
    } else if (const int direction = direction_of(c.devices, mode.legs[k]);
               direction != 0 && q.state.i[k] == 0) {
      all = both(all, judge(Real(direction) * y.i[k][1] / (y.h * c.inv_L), noise));  // L di/dt
    }
  }
  return all;
}

template <class Real>
Judgement judge_rest(const Question<Real>& q, const Mode& mode, const Expansion<Real>& y,
                     const Series<Real>& z) {
  const Constants<Real>& c = q.constants;
  Judgement all = Judgement::holds;
  if (c.dry_friction && q.state.w == 0 && mode.motion != Motion::locked && !c.speed_is_given()) {
    const Real noise = c.torque_noise * q.slack;
    if (mode.motion == Motion::stuck)
      all = both(judge(c.breakaway - z.forward[0], noise), judge(c.breakaway + z.backward[0], noise));
    else
      all = judge((mode.motion == Motion::forward ? z.forward[0] : -z.backward[0]) - c.breakaway, noise);
  }
  if (c.source_sinks || (c.inv_L_b > 0 && mode.source_feeds && z.source[0] > -c.sink)) return all;
  const Real below = z.open[0] + c.R_b * c.sink - y.bus[0];
  return both(all, judge(mode.source_feeds ? below : -below, c.volt_noise * q.slack));
}

/// False for the parts of the mode that settle() does not determine, because only events change them.
constexpr bool is_sought(int id) { return id < guard::brake; }

/// Checks the signs of the guards' leading terms (plant/settle.hpp).
template <class Real>
bool holds_in_series(const Question<Real>& q, const Mode& mode, const Expansion<Real>& y,
                     const Series<Real>& z) {
  bool ok = true;
  mode_guards(q.constants, q.gates, mode, q.dead, q.breaking, y, z, q.slack,
              [&](int id, const series::Coefficients<Real>& g, int degree, Real noise) {
                ok = ok && (!is_sought(id) || series::leading(g, degree, noise).sign >= 0);
              });
  return ok;
}

/// True if the mode is consistent. Sets `expanded` to true if y and z contain the complete expansion for the
/// mode.
template <class Real>
bool accepts(const Question<Real>& q, Mode& mode, Expansion<Real>& y, Series<Real>& z, bool& expanded) {
  const std::int8_t through_sign = mode.through_sign;
  expand_first(q.constants, q.state, q.more, mode, q.h, y, z);
  Judgement all = both(judge_legs(q, mode, y, z), judge_rest(q, mode, y, z));
  if (q.series_only && all == Judgement::holds) all = Judgement::tie;
  expanded = all == Judgement::tie;
  if (expanded) expand(q.constants, q.state, q.more, mode, q.h, y, z);
  const bool holds = expanded ? holds_in_series(q, mode, y, z) : all == Judgement::holds;
  if (!holds)
    mode.through_sign = through_sign;  // a rejected candidate must not change the sign for the next candidate
  return holds;
}

template <class Real>
bool settle_legs(const Question<Real>& q, Mode& mode, Expansion<Real>& y, Series<Real>& z, bool& expanded) {
  const unsigned open = named_legs(q, mode.legs);
  if (open == 0) return accepts(q, mode, y, z, expanded);
  std::array<unsigned, 3> leg{};
  int count = 0;
  for (unsigned k = 0; k < 3; ++k)
    if ((open >> k & 1) != 0) leg[static_cast<std::size_t>(count++)] = k;
  for (const plant::detail::Combination& tried : plant::detail::combinations_of(count)) {
    for (int n = 0; n < count; ++n) {
      const unsigned k = leg[static_cast<std::size_t>(n)];
      const LegConnections ways = ways_of(q.constants.devices, q.gates.high[k], q.gates.low[k]);
      const Connection as = tried.leg[static_cast<std::size_t>(n)];
      mode.legs[k] = is_floating(as) ? as : as == Connection::low_diode ? ways.positive : ways.negative;
    }
    if (tried.on >= 1 && connected_count(mode.legs) == 1) continue;  // a single leg conducts no current
    if (accepts(q, mode, y, z, expanded)) return true;
  }
  return false;
}

/// Settles whether the source feeds or absorbs its largest current I_sink. It feeds if the bus is below V_0 +
/// R_b I_sink.
template <class Real>
bool settle_source(const Question<Real>& q, Mode& mode, Expansion<Real>& y, Series<Real>& z, bool& expanded) {
  const Constants<Real>& c = q.constants;
  if (c.source_sinks || (c.inv_L_b > 0 && q.more.source.value > -c.sink)) {
    mode.source_feeds = true;
    return settle_legs(q, mode, y, z, expanded);
  }
  for (const bool feeds : {false, true}) {
    mode.source_feeds = feeds;
    if (settle_legs(q, mode, y, z, expanded)) return true;
  }
  return false;
}

}  // namespace detail

/// Settles the mode without trials, which nearly always suffices. A leg's window is the range between the two
/// voltages at which the leg would begin to conduct. One of two conditions must be true:
/// - each open leg (named_legs()) is clearly inside its window,
/// - two legs conduct and the third leg is clearly outside its window.
/// Returns false if trials are necessary; `mode` may then have changed.
template <class Real>
bool settle_fast(const Question<Real>& q, Mode& mode, Expansion<Real>& y, Series<Real>& z) {
  const Constants<Real>& c = q.constants;
  const State<Real>& s = q.state;
  if (c.dry_friction && plant::detail::abs(s.w) <= c.speed_noise) return false;
  for (int k = 0; k < 3; ++k)
    if (s.i[k] != 0 && plant::detail::abs(s.i[k]) <= c.amp_noise) return false;
  mode.motion = c.locked ? Motion::locked : c.dry_friction ? motion_at(s.w) : Motion::free;
  // For a source that cannot sink, `source_feeds` may depend on the source's current. This guess from the
  // present bus voltage is checked below.
  const Real open_V = c.source == Source::steady ? c.V_0 : z.open[0];
  mode.source_feeds =
      c.source_sinks || (c.inv_L_b > 0 && q.more.source.value > -c.sink) || s.bus < open_V + c.R_b * c.sink;
  const unsigned open = detail::named_legs(q, mode.legs);
  if (open == 0 && c.source_sinks) return true;
  expand_first(c, s, q.more, mode, q.h, y, z);
  using detail::Judgement;
  if (detail::judge_rest(q, mode, y, z) != Judgement::holds) return false;
  const Judgement legs = detail::judge_legs(q, mode, y, z);
  if (legs == Judgement::holds) return true;
  if (legs == Judgement::tie || connected_count(mode.legs) != 2 || (open & (open - 1)) != 0 || open == 0)
    return false;
  // When the third leg conducts, its L di/dt is two thirds of the excess voltage.
  const unsigned k = open >> 1;
  const LegConnections ways = ways_of(c.devices, q.gates.high[k], q.gates.low[k]);
  const auto stands = [&](Connection to) {
    const PoleTerms<Real>& terms = c.terms(k, to);
    return z.pole[k][0] - (terms.bus_share * y.bus[0] + terms.offset_V);
  };
  if (stands(ways.positive) < -2 * c.volt_noise)
    mode.legs[k] = ways.positive;
  else if (stands(ways.negative) > 2 * c.volt_noise)
    mode.legs[k] = ways.negative;
  else
    return false;
  return true;
}

template <class Real>
bool settle(const Question<Real>& q, Mode& mode, Expansion<Real>& y, Series<Real>& z, bool& expanded) {
  using enum Motion;
  const Constants<Real>& c = q.constants;
  if (c.speed_is_given() && !c.locked) {
    const Real along = q.state.w != 0 ? q.state.w : c.speed_rate;
    mode.motion = along > 0 ? forward : along < 0 ? backward : locked;
    return detail::settle_source(q, mode, y, z, expanded);
  }
  if (c.locked || !c.dry_friction || q.state.w != 0) {
    mode.motion = c.locked ? locked : !c.dry_friction ? free : motion_at(q.state.w);
    return detail::settle_source(q, mode, y, z, expanded);
  }
  for (const Motion motion : {stuck, forward, backward}) {
    mode.motion = motion;
    if (detail::settle_source(q, mode, y, z, expanded)) return true;
  }
  return false;
}

}  // namespace sixstep::plant::general
