// SPDX-License-Identifier: Apache-2.0
// The Taylor kernel: between events the right-hand side is polynomial in the state, so all coefficients
// follow from one recurrence (ENGINE). Everything else - guards, dense output, energy - reads these same
// polynomials.
#pragma once
#include <cmath>
#include <utility>

#include "sixstep/base/elementary.hpp"
#include "sixstep/plant/back_emf.hpp"
#include "sixstep/plant/state.hpp"
#include "sixstep/series/polynomial.hpp"

namespace sixstep::plant {

/// Parameters as the recurrence wants them, and the scales that say what rounding noise is.
template <class Real>
struct Constants {
  Real R, inv_L, K_e, inv_J, B, pole_pairs, coulomb, breakaway;
  Real V_0, inv_R_b, inv_C;  // inv_C = 0: stiff bus
  Real load = 0;             // T_load at present
  Devices devices;
  std::array<PoleTerms<Real>, 5> pole_terms;  // by Connection
  EmfTable<Real> emf;
  bool sine = false, locked = false, dry_friction = false, source_sinks = true;
  Real volt_scale, amp_scale, speed_scale, torque_scale;
  Real steady_rate;  // the part of the fastest rate that does not change, 1/s
};

/// Series over one segment. `pole` holds u_n + e_k of floating legs, or e_k itself where no leg is connected;
/// both are known to one order less than the states, which is enough.
template <class Real>
struct Expansion {
  int degree = 0;
  Real h = 0;  ///< length in seconds
  PerLeg<series::Coefficients<Real>> i, pole;
  series::Coefficients<Real> w, x, bus, torque;
  series::Coefficients<Real> phi0, phi1;  ///< sine only: cos x, sin x
};

namespace detail {

/// One instruction; written as a comparison it would cost a branch, to keep the sign of zero.
template <class Real>
inline Real abs(Real v) {
  return std::fabs(v);
}

/// The order of a term as a type: the whole recurrence is unrolled, products of short series included
/// (ENGINE: an unrolled kernel takes a quarter of the time of one with counted loops).
template <int n>
using Order = std::integral_constant<int, n>;

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
    for (int k = 0; k < 3; ++k) {
      out.i[k][j] *= factor;
      out.pole[k][j] *= factor;
    }
    for (series::Coefficients<Real>* c : {&out.w, &out.x, &out.bus, &out.torque}) (*c)[j] *= factor;
  }
  out.h *= half;
}

/// The motion's share of the recurrence, the same for every conduction mode.
template <class Real>
struct Rotor {
  bool turns;
  Real drag;  ///< load and dry friction

  Rotor(const Constants<Real>& c, Motion motion)
      : turns(motion != Motion::locked && motion != Motion::stuck),
        drag(c.load + (motion == Motion::forward    ? c.coulomb
                       : motion == Motion::backward ? -c.coulomb
                                                    : Real(0))) {}

  template <int n>
  void step(const Constants<Real>& c, Expansion<Real>& y, Order<n>, Real f) const {
    const Real net = y.torque[n] - c.B * y.w[n] - (n == 0 ? drag : Real(0));
    y.w[n + 1] = turns ? f * c.inv_J * net : Real(0);
    y.x[n + 1] = f * c.pole_pairs * y.w[n];
  }
};

/// w phi0 and w phi1 at order n: all that the back-EMF needs. A sine's cos x and sin x grow along with them.
template <bool sine, int n, class Real>
inline void shape_products(const Constants<Real>& c, Expansion<Real>& y, Real f, Real& w0, Real& w1) {
  if constexpr (sine) {
    w0 = series::product_term<n>(y.w, y.phi0);
    w1 = series::product_term<n>(y.w, y.phi1);
    y.phi0[n + 1] = -f * c.pole_pairs * w1;  // (cos x)' = -p w sin x
    y.phi1[n + 1] = f * c.pole_pairs * w0;
  } else {
    w0 = y.w[n];
    w1 = series::product_term<n>(y.w, y.x);
  }
}

/// sum over alpha phi0 i + beta phi1 i at order n, for a current series already weighted.
template <bool sine, int n, class Real>
inline Real shape_times(const Expansion<Real>& y, const series::Coefficients<Real>& alpha_i,
                        const series::Coefficients<Real>& beta_i) {
  if constexpr (sine)
    return series::product_term<n>(y.phi0, alpha_i) + series::product_term<n>(y.phi1, beta_i);
  else
    return alpha_i[n] + series::product_term<n>(y.x, beta_i);
}

/// Which legs are connected, in order; the rest float.
struct Split {
  std::array<int, 3> leg{};
  int connected = 0;

  explicit Split(const Legs& legs) {
    int back = 3;
    for (int k = 2; k >= 0; --k)
      if (is_floating(legs[k])) leg[--back] = k;
    for (int k = 0; k < 3; ++k)
      if (!is_floating(legs[k])) leg[connected++] = k;
  }
};

/// U_s: C dU_s/dt = (V_0 - U_s)/R_b - i_dc while the source feeds.
template <int n, class Real>
inline void bus_step(const Constants<Real>& c, const Mode& mode, Expansion<Real>& y, Real f) {
  Real dc = 0;
  for (int k = 0; k < 3; ++k)
    if (is_high(mode.legs[k])) dc += y.i[k][n];
  const Real feed = mode.source_feeds ? c.inv_R_b * ((n == 0 ? c.V_0 : Real(0)) - y.bus[n]) : Real(0);
  y.bus[n + 1] = f * c.inv_C * (feed - dc);
}

/// Fewer than two legs connected: no current; the rotor coasts and the floating terminals are watched.
template <bool sine, class Real>
struct NoCurrent {
  const EmfPiece<Real>& piece;
  PerLeg<Real> alpha{}, beta{};
  Real share = 0, offset = 0;

  NoCurrent(const Constants<Real>& c, const Mode& mode, const Split& split, const EmfPiece<Real>& p)
      : piece(p) {
    alpha = p.alpha;
    beta = p.beta;
    if (split.connected == 0) return;
    const int s = split.leg[0];
    const PoleTerms<Real>& terms = c.pole_terms[static_cast<std::size_t>(mode.legs[s])];
    share = terms.bus_share;
    offset = terms.offset_V;
    for (int k = 0; k < 3; ++k) {
      alpha[k] -= p.alpha[s];
      beta[k] -= p.beta[s];
    }
  }
  template <int n>
  void step(const Constants<Real>& c, Expansion<Real>& y, Order<n>, Real f) {
    Real w0, w1;
    shape_products<sine, n>(c, y, f, w0, w1);
    const Real rail = share * y.bus[n] + (n == 0 ? offset : Real(0));
    for (int k = 0; k < 3; ++k) {
      y.pole[k][n] = rail + c.K_e * (alpha[k] * w0 + beta[k] * w1);
      y.i[k][n + 1] = 0;
    }
    y.torque[n] = 0;
  }
};

/// Two legs share one current: one recurrence.
template <bool sine, class Real>
struct OneCurrent {
  int j, k, floating;
  Real share, offset, R, alpha, beta;                     // of leg j minus leg k
  Real mean_share, mean_offset, mean_r, alpha_m, beta_m;  // of the floating terminal
  series::Coefficients<Real> alpha_i, beta_i;

  OneCurrent(const Constants<Real>& c, const Mode& mode, const Split& split, const EmfPiece<Real>& p)
      : j(split.leg[0]), k(split.leg[1]), floating(split.leg[2]) {
    const PoleTerms<Real>& a = c.pole_terms[static_cast<std::size_t>(mode.legs[j])];
    const PoleTerms<Real>& b = c.pole_terms[static_cast<std::size_t>(mode.legs[k])];
    share = a.bus_share - b.bus_share;
    offset = a.offset_V - b.offset_V;
    R = 2 * c.R + a.r_ohm + b.r_ohm;
    alpha = p.alpha[j] - p.alpha[k];
    beta = p.beta[j] - p.beta[k];
    mean_share = (a.bus_share + b.bus_share) / 2;
    mean_offset = (a.offset_V + b.offset_V) / 2;
    mean_r = (a.r_ohm - b.r_ohm) / 2;
    alpha_m = p.alpha[floating] - (p.alpha[j] + p.alpha[k]) / 2;
    beta_m = p.beta[floating] - (p.beta[j] + p.beta[k]) / 2;
  }
  template <int n>
  void step(const Constants<Real>& c, Expansion<Real>& y, Order<n>, Real f) {
    Real w0, w1;
    shape_products<sine, n>(c, y, f, w0, w1);
    const Real i = y.i[j][n], U = y.bus[n];
    // 2 L di/dt = u_j - u_k - 2 R i - (e_j - e_k), MODEL 1 eq. 1 with eq. 5
    const Real drive = share * U + (n == 0 ? offset : Real(0)) - R * i - c.K_e * (alpha * w0 + beta * w1);
    y.i[j][n + 1] = f * c.inv_L * Real(0.5) * drive;
    y.i[k][n + 1] = -y.i[j][n + 1];
    y.i[floating][n + 1] = 0;
    y.pole[floating][n] =
        mean_share * U + (n == 0 ? mean_offset : Real(0)) - mean_r * i + c.K_e * (alpha_m * w0 + beta_m * w1);
    alpha_i[n] = alpha * i;
    beta_i[n] = beta * i;
    if constexpr (!sine) {
      if (beta == 0) {  // both on their flat tops: no product at all
        y.torque[n] = c.K_e * alpha_i[n];
        return;
      }
    }
    y.torque[n] = c.K_e * shape_times<sine, n>(y, alpha_i, beta_i);
  }
};

/// All three legs: two recurrences, the third current follows.
template <bool sine, class Real>
struct TwoCurrents {
  const EmfPiece<Real>& p;
  PerLeg<Real> share, offset, R;
  series::Coefficients<Real> alpha_i, beta_i;

  TwoCurrents(const Constants<Real>& c, const Mode& mode, const Split&, const EmfPiece<Real>& piece)
      : p(piece) {
    for (int k = 0; k < 3; ++k) {
      const PoleTerms<Real>& t = c.pole_terms[static_cast<std::size_t>(mode.legs[k])];
      share[k] = t.bus_share;
      offset[k] = t.offset_V;
      R[k] = c.R + t.r_ohm;
    }
  }
  template <int n>
  void step(const Constants<Real>& c, Expansion<Real>& y, Order<n>, Real f) {
    Real w0, w1;
    shape_products<sine, n>(c, y, f, w0, w1);
    PerLeg<Real> v;
    for (int k = 0; k < 3; ++k)
      v[k] = share[k] * y.bus[n] + (n == 0 ? offset[k] : Real(0)) - R[k] * y.i[k][n] -
             c.K_e * (p.alpha[k] * w0 + p.beta[k] * w1);
    const Real u_n = (v[0] + v[1] + v[2]) * Real(1.0L / 3);
    y.i[0][n + 1] = f * c.inv_L * (v[0] - u_n);
    y.i[1][n + 1] = f * c.inv_L * (v[1] - u_n);
    y.i[2][n + 1] = -(y.i[0][n + 1] + y.i[1][n + 1]);
    alpha_i[n] = p.alpha[0] * y.i[0][n] + p.alpha[1] * y.i[1][n] + p.alpha[2] * y.i[2][n];
    beta_i[n] = p.beta[0] * y.i[0][n] + p.beta[1] * y.i[1][n] + p.beta[2] * y.i[2][n];
    y.torque[n] = c.K_e * shape_times<sine, n>(y, alpha_i, beta_i);
  }
};

/// How far the last two terms stand above the rounding level of their states, 1 = at it.
template <class Real>
struct Convergence {
  Real i_limit, w_limit, bus_limit;
  Real before = 0, last = 0;

  explicit Convergence(const Constants<Real>& c) {
    // Well below the last bit of each state's natural scale, so that truncation never adds up.
    constexpr Real per_scale = Real(1LL << 57) * (sizeof(Real) > 8 ? 2048 : 1);
    i_limit = per_scale / c.amp_scale;
    w_limit = per_scale / c.speed_scale;
    bus_limit = c.inv_C > 0 ? per_scale / c.volt_scale : Real(0);
  }
  void look(const Expansion<Real>& y, int n) {
    before = last;
    last = (abs(y.i[0][n]) + abs(y.i[1][n]) + abs(y.i[2][n])) * i_limit + abs(y.w[n]) * w_limit +
           abs(y.bus[n]) * bus_limit;
  }
  bool reached() const { return last < 1 && before < 1; }
};

/// Terms n + 1 of all series from terms n; true where that was enough.
template <int n, class Currents, class Real>
[[gnu::always_inline]] inline bool take_order(const Constants<Real>& c, const Mode& mode, Currents& currents,
                                              const Rotor<Real>& rotor, Convergence<Real>& convergence,
                                              Expansion<Real>& y) {
  const Real f = y.h * Real(1.0L / (n + 1));
  currents.step(c, y, Order<n>{}, f);
  rotor.step(c, y, Order<n>{}, f);
  if (c.inv_C > 0)
    bus_step<n>(c, mode, y, f);
  else
    y.bus[n + 1] = 0;
  y.degree = n + 1;
  if constexpr (n < 1) return false;
  convergence.look(y, n + 1);
  return convergence.reached();
}

/// Order by order until the last two terms are below rounding, or the degree is used up.
template <class Currents, class Real>
void recurrence(const Constants<Real>& c, const Mode& mode, Currents currents, Expansion<Real>& y) {
  const Rotor<Real> rotor(c, mode.motion);
  Convergence<Real> convergence(c);
  [&]<int... n>(std::integer_sequence<int, n...>) {
    static_cast<void>((take_order<n>(c, mode, currents, rotor, convergence, y) || ...));
  }
  (std::make_integer_sequence<int, series::max_degree>{});
  for (int k = 0; k < 3; ++k) y.pole[k][y.degree] = 0;
  y.torque[y.degree] = 0;
  if (!convergence.reached()) shorten(y, convergence.last, convergence.before);
}

template <bool sine, class Real>
void expand_shape(const Constants<Real>& c, const State<Real>& state, const Mode& mode, Expansion<Real>& y) {
  const EmfPiece<Real>& piece = c.emf[sector_in_turn(state.sector)].piece[mode.piece];
  const Split split(mode.legs);
  if (split.connected == 3)
    recurrence(c, mode, TwoCurrents<sine, Real>(c, mode, split, piece), y);
  else if (split.connected == 2)
    recurrence(c, mode, OneCurrent<sine, Real>(c, mode, split, piece), y);
  else
    recurrence(c, mode, NoCurrent<sine, Real>(c, mode, split, piece), y);
}

}  // namespace detail

/// Expands the state in the given mode over `wanted` seconds, or over as much of it as full accuracy allows.
template <class Real>
void expand(const Constants<Real>& c, const State<Real>& state, const Mode& mode, Real wanted,
            Expansion<Real>& y) {
  y.h = wanted;
  for (int k = 0; k < 3; ++k) y.i[k][0] = state.i[k];
  y.w[0] = mode.motion == Motion::locked || mode.motion == Motion::stuck ? Real(0) : state.w;
  y.x[0] = state.x;
  y.bus[0] = state.bus;
  if (c.sine) {
    const base::SinCos shape = base::sin_cos(static_cast<double>(state.x));
    y.phi0[0] = static_cast<Real>(shape.cos);
    y.phi1[0] = static_cast<Real>(shape.sin);
    detail::expand_shape<true>(c, state, mode, y);
  } else {
    detail::expand_shape<false>(c, state, mode, y);
  }
}

/// A cap on the length, so that few expansions are thrown away: about half of the fastest time constant
/// present.
template <class Real>
Real useful_length(const Constants<Real>& c, const State<Real>& state) {
  return Real(0.5) / (c.steady_rate + c.pole_pairs * detail::abs(state.w));
}

}  // namespace sixstep::plant
