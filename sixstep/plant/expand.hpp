// SPDX-License-Identifier: Apache-2.0
// The Taylor kernel: all coefficients of a segment, order by order, until rounding level is reached.
#pragma once
#include <utility>

#include "sixstep/base/elementary.hpp"
#include "sixstep/plant/recurrences.hpp"
#include "sixstep/plant/state.hpp"

namespace sixstep::plant {

namespace detail {

/// Halves the length until the last two terms are below rounding; exact, since only powers of two are used.
template <class Real>
void shorten(Expansion<Real>& out, Real excess_last, Real excess_before) {
  int halvings = 0;
  const int n = out.degree;
  for (Real a = excess_last, b = excess_before; a > 1 || b > 1; ++halvings) {
    for (int j = 0; j < n; ++j) a /= 2;
    for (int j = 0; j < n - 1; ++j) b /= 2;
  }
  Real factor = 1, half = 1;
  for (int j = 0; j < halvings; ++j) half /= 2;
  for (int j = 0; j <= n; ++j, factor *= half) {
    for (int k = 0; k < 3; ++k) out.i[k][j] *= factor;
    for (series::Coefficients<Real>* c : {&out.w, &out.x, &out.bus, &out.torque, &out.phi0, &out.phi1})
      (*c)[j] *= factor;
  }
  out.h *= half;
}

/// How far the last two terms stand above the rounding level of their states, 1 = at it.
template <class Real>
struct Convergence {
  Real before = 0, last = 0;

  /// A sine's shape counts too: without current it alone decides how far a floating terminal's voltage is
  /// known.
  template <bool sine, bool bus>
  void look(const Constants<Real>& c, const Expansion<Real>& y, int n, Real currents) {
    before = last;
    last = currents * c.amp_limit + abs(y.w[n]) * c.speed_limit;
    if constexpr (bus) last += abs(y.bus[n]) * c.volt_limit;
    if constexpr (sine) last += (abs(y.phi0[n]) + abs(y.phi1[n])) * terms_per_scale<Real>;
  }
  /// One small term may be a symmetry's zero; a small one after one not much larger is the end of the series.
  bool reached() const { return last < 1 && before < 4096; }
};

/// Terms n + 1 of all series from terms n; true where that was enough.
template <int n, bool bus, class Currents, class Real>
[[gnu::always_inline]] inline bool take_order(const Constants<Real>& c, const Mode& mode, Currents& currents,
                                              const Rotor<Real>& rotor, Convergence<Real>& convergence,
                                              Expansion<Real>& y) {
  const Real f = y.h * Real(1.0L / (n + 1));
  currents.template step<n, bus>(c, rotor, y, f);
  if constexpr (bus)
    bus_step<n>(c, mode, y, f);
  else
    y.bus[n + 1] = 0;
  y.degree = n + 1;
  if constexpr (n < 5) return false;  // no segment worth taking needs fewer, and each look costs
  convergence.template look<Currents::sine_shape, bus>(c, y, n + 1, currents.size(y, n + 1));
  return n >= 6 && convergence.reached();
}

/// Order by order until the last two terms are below rounding, or the degree is used up.
template <bool bus, class Currents, class Real>
void recurrence_with(const Constants<Real>& c, const Mode& mode, Currents& currents, Expansion<Real>& y) {
  const Rotor<Real> rotor(c, mode.motion);
  Convergence<Real> convergence;
  [&]<int... n>(std::integer_sequence<int, n...>) {
    static_cast<void>((take_order<n, bus>(c, mode, currents, rotor, convergence, y) || ...));
  }
  (std::make_integer_sequence<int, series::max_degree>{});
  y.torque[y.degree] = 0;
  if (!convergence.reached()) shorten(y, convergence.last, convergence.before);
}

template <class Currents, class Real>
void recurrence(const Constants<Real>& c, const Mode& mode, Currents&& currents, Expansion<Real>& y) {
  if (c.inv_C > 0)
    recurrence_with<true>(c, mode, currents, y);
  else
    recurrence_with<false>(c, mode, currents, y);
}

template <bool sine, class Real>
void expand_shape(const Constants<Real>& c, const Mode& mode, Expansion<Real>& y) {
  const EmfPiece<Real>& piece = c.emf[mode.sector].piece[mode.piece];
  const Split& split = split_of(mode.legs);
  if (split.connected == 3) return recurrence(c, mode, TwoCurrents<sine, Real>(c, mode, split, piece, y), y);
  if (split.connected < 2) return recurrence(c, mode, NoCurrent<sine, Real>(c, mode, split, piece, y), y);
  if constexpr (!sine) {
    const bool flat = piece.beta[split.leg[0]] == piece.beta[split.leg[1]];
    if (flat) return recurrence(c, mode, FlatPair<Real>(c, mode, split, piece, y), y);
  }
  recurrence(c, mode, OneCurrent<sine, Real>(c, mode, split, piece, y), y);
}

}  // namespace detail

/// Expands the state in the given mode over `wanted` seconds, or over as much of it as full accuracy allows.
template <class Real>
void expand(const Constants<Real>& c, const State<Real>& state, const Mode& mode, Real wanted,
            Expansion<Real>& y) {
  y.h = wanted;
  y.inv_ph = 1 / (c.pole_pairs * wanted);
  for (int k = 0; k < 3; ++k) y.i[k][0] = state.i[k];
  y.w[0] = mode.motion == Motion::locked || mode.motion == Motion::stuck ? Real(0) : state.w;
  y.x[0] = state.x;
  y.bus[0] = state.bus;
  if (c.sine) {
    const base::SinCos shape = base::sin_cos(static_cast<double>(state.x));
    y.phi0[0] = static_cast<Real>(shape.cos);
    y.phi1[0] = static_cast<Real>(shape.sin);
    detail::expand_shape<true>(c, mode, y);
  } else {
    detail::expand_shape<false>(c, mode, y);
  }
}

/// w phi0 and w phi1 over the whole degree, for a floating terminal that may reach a rail.
template <class Real>
series::Coefficients<Real> pole_series(const Constants<Real>& c, const Expansion<Real>& y, int k) {
  const PoleLaw<Real>& law = y.pole[k];
  series::Coefficients<Real> u;
  for (int n = 0; n <= y.degree; ++n) {
    const Real w0 = c.sine ? series::product_term(y.w, y.phi0, n) : y.w[n];
    const Real w1 = series::product_term(y.w, c.sine ? y.phi1 : y.x, n);
    u[n] = law.bus * y.bus[n] + law.i * y.i[law.leg][n] + law.w0 * w0 + law.w1 * w1;
  }
  u[0] += law.offset;
  return u;
}

/// A cap on the length, so that few expansions are thrown away: about half of the fastest time constant
/// present.
template <class Real>
Real useful_length(const Constants<Real>& c, const State<Real>& state) {
  return Real(0.5) / (c.steady_rate + c.pole_pairs * detail::abs(state.w));
}

}  // namespace sixstep::plant
