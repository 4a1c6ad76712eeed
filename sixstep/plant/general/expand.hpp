// SPDX-License-Identifier: Apache-2.0
// The general plant's series over one segment: order by order until what is left is rounding, or shorter where the degree
// does not reach so far.
#pragma once
#include "sixstep/plant/expand.hpp"
#include "sixstep/plant/general/recurrence.hpp"
#include "sixstep/series/first_root.hpp"

namespace sixstep::plant::general {

namespace detail {

/// cos and sin of m theta_e where the rotor stands: the sector by exact sixths of a turn, the angle in it by its own.
template <class Real>
void rotation_at(int order, const State<Real>& s, int sector, Real& cos, Real& sin) {
  Real turn_cos, turn_sin;
  turn_by<Real>(2 * order * sector, turn_cos, turn_sin);
  const base::SinCos in = base::sin_cos(order * static_cast<double>(s.x));
  cos = turn_cos * Real(in.cos) - turn_sin * Real(in.sin);
  sin = turn_sin * Real(in.cos) + turn_cos * Real(in.sin);
}

/// The load's angle: theta_m/n, less the twist of an elastic shaft.
template <class Real>
Real load_angle(const Constants<Real>& c, const State<Real>& s, const More<Real>& m) {
  const Real rotor = (Real(s.sector) * Real(base::sector_rad) + s.x) / c.pole_pairs;
  return c.inv_gear * rotor - m.twist;
}

template <class Real>
void begin(const Constants<Real>& c, const State<Real>& s, const More<Real>& m, const Mode& mode,
           Expansion<Real>& y, Series<Real>& z) {
  for (int k = 0; k < 3; ++k) y.i[k][0] = s.i[k];
  y.w[0] = turns(mode.motion) ? s.w : Real(0);
  y.x[0] = s.x;
  y.bus[0] = s.bus;
  z.loop[0] = m.loop;
  z.source[0] = mode.source_feeds ? m.source : Real(0);
  z.load_w[0] = m.load_w;
  z.twist[0] = m.twist;
  for (std::size_t r = 0; r < c.rotations; ++r)
    rotation_at(c.shape.rotations[r].order, s, mode.sector, z.cos[r][0], z.sin[r][0]);
  if (c.gravity != 0) {
    const base::SinCos turn = base::sin_cos(static_cast<double>(load_angle(c, s, m) - c.gravity_angle));
    z.turn_cos[0] = Real(turn.cos);
    z.turn_sin[0] = Real(turn.sin);
  }
}

/// How far term n stands above the rounding level of its state, all together; 1 = at it.
template <class Real>
Real size_of(const Constants<Real>& c, const Expansion<Real>& y, const Series<Real>& z, int n) {
  using plant::detail::abs;
  Real size = (abs(y.i[0][n]) + abs(y.i[1][n]) + abs(y.i[2][n])) / c.amp_scale + abs(y.w[n]) / c.speed_scale;
  if (c.inv_C > 0) size += abs(y.bus[n]) / c.volt_scale;
  if (c.inv_L_b > 0) size += abs(z.source[n]) / c.amp_scale;
  if (c.has_loop) size += abs(z.loop[n]) / c.amp_scale;
  if (c.elastic) size += abs(z.load_w[n]) / c.speed_scale + abs(z.twist[n]) * c.stiffness / c.torque_scale;
  for (std::size_t r = 0; r < c.rotations; ++r) size += abs(z.cos[r][n]) + abs(z.sin[r][n]);
  if (c.gravity != 0) size += abs(z.turn_cos[n]) + abs(z.turn_sin[n]);
  return size * terms_per_scale<Real>;
}

template <class Real, class Visit>
void for_each_series(const Constants<Real>& c, Expansion<Real>& y, Series<Real>& z, Visit&& visit) {
  for (int k = 0; k < 3; ++k) visit(y.i[k]), visit(z.pole[k]), visit(z.emf[k]);
  for (auto* of : {&y.w, &y.x, &y.bus, &y.torque, &z.shaft, &z.loop, &z.source, &z.load_w, &z.twist, &z.load,
                   &z.cogging, &z.turn_cos, &z.turn_sin})
    visit(*of);
  for (std::size_t r = 0; r < c.rotations; ++r) visit(z.cos[r]), visit(z.sin[r]);
}

/// Halves the length until both of the last terms are below rounding (plant/expand.hpp).
template <class Real>
void shorten(const Constants<Real>& c, Expansion<Real>& y, Series<Real>& z) {
  int halvings = 0;
  Real last = size_of(c, y, z, y.degree), before = size_of(c, y, z, y.degree - 1);
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

template <class Real>
void note_reach(Expansion<Real>& y) {
  for (int k = 0; k < 3; ++k) y.reach_i[k] = series::tail_bound(y.i[k], y.degree);
  y.reach_w = series::tail_bound(y.w, y.degree);
  y.reach_x = series::tail_bound(y.x, y.degree);
  y.later_x = y.reach_x - plant::detail::abs(y.x[1]);
}

}  // namespace detail

/// Only what begins: terms 0 of voltages and torques, terms 1 of the states.
template <class Real>
void expand_first(const Constants<Real>& c, const State<Real>& s, const More<Real>& m, const Mode& mode,
                  Real h, Expansion<Real>& y, Series<Real>& z) {
  y.h = h;
  y.degree = 1;
  detail::begin(c, s, m, mode, y, z);
  Recurrence<Real>(c, mode, y, z).take_order(0);
}

/// The state in the given mode over `wanted` seconds, or over as much of it as full accuracy allows.
template <class Real>
void expand(const Constants<Real>& c, const State<Real>& s, const More<Real>& m, const Mode& mode,
            Real wanted, Expansion<Real>& y, Series<Real>& z) {
  y.h = wanted;
  y.degree = series::max_degree;
  detail::begin(c, s, m, mode, y, z);
  Recurrence<Real> recurrence(c, mode, y, z);
  // From rest and without current some terms are a symmetry's zeros: they say nothing then.
  const bool from_nothing = s.w == 0 && s.i[0] == 0 && s.i[1] == 0;
  Real last = 0, before = 0;
  bool reached = false;
  for (int n = 0; n < series::max_degree && !reached; ++n) {
    recurrence.take_order(n);
    if (n < 3) continue;
    before = last;
    last = detail::size_of(c, y, z, n + 1);
    reached = n >= 5 && last < 8 && before < 4096 && !from_nothing;
    if (reached) y.degree = n + 1;
  }
  y.torque[y.degree] = z.shaft[y.degree] = z.load[y.degree] = z.cogging[y.degree] = 0;
  for (int k = 0; k < 3; ++k) z.pole[k][y.degree] = z.emf[k][y.degree] = 0;
  if (!(c.inv_L_b > 0)) z.source[y.degree] = 0;
  if (!c.elastic) z.load_w[y.degree] = c.inv_gear * y.w[y.degree];
  if (!reached) detail::shorten(c, y, z);
  detail::note_reach(y);
}

/// `wanted`, or half of the fastest time constant present.
template <class Real>
Real useful_length(const Constants<Real>& c, const State<Real>& s, Real wanted) {
  const Real rate = c.steady_rate + c.turning_rate * plant::detail::abs(s.w);
  return wanted * rate <= Real(0.5) ? wanted : Real(0.5) / rate;
}

}  // namespace sixstep::plant::general
