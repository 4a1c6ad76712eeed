// SPDX-License-Identifier: Apache-2.0
// Computes the general plant's series over one segment, order by order until the remaining terms are below
// rounding level. If the highest degree is not sufficient, the segment is shortened.
#pragma once
#include "sixstep/plant/expand.hpp"
#include "sixstep/plant/general/recurrence.hpp"
#include "sixstep/series/first_root.hpp"

namespace sixstep::plant::general {

namespace detail {

/// cos and sin of order * theta_e at the rotor's position. The sectors are exact sixths of a turn; the angle
/// within the sector is added separately.
template <class Real>
void rotation_at(int order, const State<Real>& s, int sector, Real& cos, Real& sin) {
  Real turn_cos, turn_sin;
  turn_by<Real>(2 * order * sector, turn_cos, turn_sin);
  const base::SinCos in = base::sin_cos(order * static_cast<double>(s.x));
  cos = turn_cos * Real(in.cos) - turn_sin * Real(in.sin);
  sin = turn_sin * Real(in.cos) + turn_cos * Real(in.sin);
}

/// The load's angle, rad: theta_m/n, minus the twist of an elastic shaft.
template <class Real>
Real load_angle(const Constants<Real>& c, const State<Real>& s, const More<Real>& m) {
  const Real rotor = (Real(s.sector) * Real(base::sector_rad) + s.x) / c.pole_pairs;
  return c.inv_gear * rotor - m.twist.value;
}

template <class Real>
void begin_supply(const Constants<Real>& c, const More<Real>& m, Series<Real>& z) {
  z.capacitor[0] = m.capacitor.value;
  z.charge[0] = m.charge.value;
  z.slow[0] = m.slow.value;
  if (c.source != Source::single_phase && c.source != Source::three_phase) return;
  const base::SinCos at = base::sin_cos(static_cast<double>(m.phase.value));
  z.phase[0] = m.phase.value;
  z.mains_cos[0] = Real(at.cos);
  z.mains_sin[0] = Real(at.sin);
}

template <class Real>
void begin(const Constants<Real>& c, const State<Real>& s, const More<Real>& m, const Mode& mode,
           Expansion<Real>& y, Series<Real>& z) {
  for (int k = 0; k < 3; ++k) y.i[k][0] = s.i[k];
  y.w[0] = turns(mode.motion) ? s.w : Real(0);
  y.x[0] = s.x;
  y.bus[0] = s.bus;
  z.loop[0] = m.loop.value;
  z.source[0] = mode.source_feeds ? m.source.value : -c.sink;
  z.load_w[0] = m.load_w.value;
  z.twist[0] = m.twist.value;
  begin_supply(c, m, z);
  for (std::size_t r = 0; r < c.rotations; ++r)
    rotation_at(c.shape.rotations[r].order, s, mode.sector, z.cos[r][0], z.sin[r][0]);
  if (c.gravity != 0) {
    const base::SinCos turn = base::sin_cos(static_cast<double>(load_angle(c, s, m) - c.gravity_angle));
    z.turn_cos[0] = Real(turn.cos);
    z.turn_sin[0] = Real(turn.sin);
  }
}

/// Sets the last term of the quantities that are not states to 0, because the recurrence computes one term
/// more for the states.
template <class Real>
void end(const Constants<Real>& c, Expansion<Real>& y, Series<Real>& z) {
  const int n = y.degree;
  for (auto* of :
       {&y.torque, &z.forward, &z.backward, &z.through, &z.load, &z.cogging, &z.open, &z.capacitor_A})
    (*of)[n] = 0;
  for (int k = 0; k < 3; ++k) z.pole[k][n] = z.emf[k][n] = 0;
  if (!(c.inv_L_b > 0)) z.source[n] = 0;
  if (c.R_C > 0) y.bus[n] = 0;
  if (!c.elastic) z.load_w[n] = c.inv_gear * y.w[n];
}

/// False if only currents and speed change: for a star on a stiff bus, with a trapezoid and a rigid shaft.
template <class Real>
bool moves_more(const Constants<Real>& c) {
  return c.inv_C > 0 || c.inv_L_b > 0 || c.has_loop || c.elastic || c.mains_peak > 0 || c.rotations > 0 ||
         c.gravity != 0;
}

/// The part of size_of() for all quantities except currents and speed.
template <class Real>
[[gnu::noinline]] Real size_of_more(const Constants<Real>& c, const Expansion<Real>& y, const Series<Real>& z,
                                    int n) {
  using plant::detail::abs;
  Real size = 0;
  if (c.inv_C > 0) size += abs((c.R_C > 0 ? z.capacitor : y.bus)[n]) / c.volt_scale;
  if (c.inv_L_b > 0) size += abs(z.source[n]) / c.amp_scale;
  if (c.has_loop) size += abs(z.loop[n]) / c.amp_scale;
  if (c.elastic) size += abs(z.load_w[n]) / c.speed_scale + abs(z.twist[n]) * c.stiffness / c.torque_scale;
  if (c.source == Source::battery) size += abs(z.charge[n]) + abs(z.slow[n]) / c.volt_scale;
  if (c.mains_peak > 0) size += abs(z.mains_cos[n]) + abs(z.mains_sin[n]);
  for (std::size_t r = 0; r < c.rotations; ++r) size += abs(z.cos[r][n]) + abs(z.sin[r][n]);
  if (c.gravity != 0) size += abs(z.turn_cos[n]) + abs(z.turn_sin[n]);
  return size;
}

/// Sum of the sizes of term n of all states, each relative to its rounding level. `more`: result of
/// moves_more().
template <class Real>
[[gnu::always_inline]] inline Real size_of(const Constants<Real>& c, const Expansion<Real>& y,
                                           const Series<Real>& z, int n, bool more) {
  using plant::detail::abs;
  Real size = (abs(y.i[0][n]) + abs(y.i[1][n]) + abs(y.i[2][n])) * c.per_amp + abs(y.w[n]) * c.per_speed;
  if (more) size += size_of_more(c, y, z, n);
  return size * terms_per_scale<Real>;
}

template <class Real, class Visit>
void for_each_series(const Constants<Real>& c, Expansion<Real>& y, Series<Real>& z, Visit&& visit) {
  for (int k = 0; k < 3; ++k) visit(y.i[k]), visit(z.pole[k]), visit(z.emf[k]);
  for (auto* of :
       {&y.w,         &y.x,           &y.bus,    &y.torque, &z.forward, &z.backward,  &z.through,   &z.loop,
        &z.source,    &z.load_w,      &z.twist,  &z.load,   &z.cogging, &z.turn_cos,  &z.turn_sin,  &z.open,
        &z.capacitor, &z.capacitor_A, &z.charge, &z.slow,   &z.phase,   &z.mains_cos, &z.mains_sin, &z.d,
        &z.q})
    visit(*of);
  for (std::size_t r = 0; r < c.rotations; ++r) visit(z.cos[r]), visit(z.sin[r]);
}

/// Halves the length until the last two terms are below rounding level (plant/expand.hpp).
template <class Real>
void shorten(const Constants<Real>& c, Expansion<Real>& y, Series<Real>& z) {
  int halvings = 0;
  const bool more = moves_more(c);
  Real last = size_of(c, y, z, y.degree, more), before = size_of(c, y, z, y.degree - 1, more);
  for (; (last > 1 || before > 1) && halvings < plant::detail::most_halvings; ++halvings) {
    for (int j = 0; j < y.degree; ++j) last /= 2;
    for (int j = 0; j < y.degree - 1; ++j) before /= 2;
  }
  Real half = 1;
  for (int j = 0; j < halvings; ++j) half /= 2;
  for_each_series(c, y, z, [&](series::Coefficients<Real>& of) {
    Real factor = 1;
    for (int j = 0; j <= y.degree; ++j, factor *= half) of[j] *= factor;
  });
  y.h *= half;
}

/// Bounds of the changes within the segment. With angle x, speed w, pole pairs p and length h, x_(n+1) = p h
/// w_n/(n + 1). The terms of x after the first are therefore at most p h/2 times the change of the speed.
template <class Real>
[[gnu::always_inline]] inline void note_reach(const Constants<Real>& c, const Mode& mode,
                                              Expansion<Real>& y) {
  for (std::size_t k = 0; k < 3; ++k)
    y.reach_i[k] = is_floating(mode.legs[k]) ? Real(0) : series::tail_bound(y.i[k], y.degree);
  y.reach_w = series::tail_bound(y.w, y.degree);
  y.later_x = c.pole_pairs * y.h * y.reach_w / 2;
  y.reach_x = plant::detail::abs(y.x[1]) + y.later_x;
}

template <class Real>
[[gnu::always_inline]] inline void grow(const Constants<Real>& c, const State<Real>& s, const More<Real>& m,
                                        Mode& mode, Real wanted, Expansion<Real>& y, Series<Real>& z) {
  y.h = wanted;
  y.degree = series::max_degree;
  begin(c, s, m, mode, y, z);
  ShaftTerms<Real> shaft(c, mode, m.load.value, y, z);
  Recurrence<Real> recurrence(c, mode, y, z);
  const bool more = moves_more(c);
  // At rest and without current some terms are zero by symmetry, so that a zero term does not show
  // convergence.
  const bool from_nothing = s.w == 0 && s.i[0] == 0 && s.i[1] == 0;
  Real last = 0, before = 0;
  bool reached = false;
  for (int n = 0; n < series::max_degree && !reached; ++n) {
    recurrence.take_order(n, shaft);
    if (n < 3) continue;
    before = last;
    last = size_of(c, y, z, n + 1, more);
    reached = n >= 5 && last < 8 && before < 4096 && !from_nothing;
    if (reached) y.degree = n + 1;
  }
  end(c, y, z);
  if (!reached) shorten(c, y, z);
  note_reach(c, mode, y);
}

}  // namespace detail

/// Expands only the first terms: term 0 of voltages and torques, term 1 of the states.
template <class Real>
void expand_first(const Constants<Real>& c, const State<Real>& s, const More<Real>& m, Mode& mode, Real h,
                  Expansion<Real>& y, Series<Real>& z) {
  y.h = h;
  y.degree = 1;
  detail::begin(c, s, m, mode, y, z);
  ShaftTerms<Real> shaft(c, mode, m.load.value, y, z);
  Recurrence<Real>(c, mode, y, z).take_order(0, shaft);
}

/// Expands the state in the given mode over the time `wanted`, s, or over less if the accuracy requires it.
template <class Real>
void expand(const Constants<Real>& c, const State<Real>& s, const More<Real>& m, Mode& mode, Real wanted,
            Expansion<Real>& y, Series<Real>& z) {
  detail::grow(c, s, m, mode, wanted, y, z);
}
/// The version for double is compiled once for any x86-64 processor and once for processors with AVX
/// (plant/expand.hpp); both versions return the same bits.
void expand(const Constants<double>& c, const State<double>& s, const More<double>& m, Mode& mode,
            double wanted, Expansion<double>& y, Series<double>& z);

/// The smaller of `wanted`, s, and half of the fastest time constant.
template <class Real>
Real useful_length(const Constants<Real>& c, const State<Real>& s, Real wanted) {
  const Real rate = c.steady_rate + c.turning_rate * plant::detail::abs(s.w);
  return wanted * rate <= Real(0.5) ? wanted : Real(0.5) / rate;
}

}  // namespace sixstep::plant::general
