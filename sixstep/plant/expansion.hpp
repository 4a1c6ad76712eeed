// SPDX-License-Identifier: Apache-2.0
// The Taylor kernel: between events the right-hand side is polynomial in the state, so all coefficients
// follow from one recurrence (ENGINE). Everything else - guards, dense output, energy - reads these same
// polynomials.
#pragma once
#include <cmath>

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
  EmfTable<Real> emf;
  bool sine = false, locked = false, dry_friction = false, source_sinks = true;
  Real volt_scale, amp_scale, speed_scale, torque_scale;
};

template <class Real>
struct Expansion {
  int degree = 0;
  Real h = 0;                                       ///< length in seconds
  PerLeg<series::Coefficients<Real>> i, emf, pole;  ///< pole: of floating legs only, u_n + e_k
  series::Coefficients<Real> w, x, bus, torque;
  series::Coefficients<Real> phi0, phi1;  ///< sine only: cos x, sin x
};

namespace detail {

template <class Real>
constexpr Real abs(Real v) {
  return v < 0 ? -v : v;
}

/// Leg terms of the present connections, masks included: a floating leg carries no current.
template <class Real>
struct LegTerms {
  PerLeg<Real> on{}, share{}, offset{}, r{}, high{};
  Real inv_count = 0;
  bool star_free = false;
};

template <class Real>
LegTerms<Real> leg_terms(const Legs& legs, const Devices& devices) {
  LegTerms<Real> t;
  int count = 0;
  for (int k = 0; k < 3; ++k) {
    const PoleTerms<Real> p = pole_terms<Real>(legs[k], devices);
    t.on[k] = is_floating(legs[k]) ? Real(0) : Real(1);
    t.share[k] = p.bus_share;
    t.offset[k] = p.offset_V;
    t.r[k] = p.r_ohm;
    t.high[k] = is_high(legs[k]) ? Real(1) : Real(0);
    count += !is_floating(legs[k]);
  }
  t.star_free = count == 0;
  t.inv_count = count > 0 ? 1 / Real(count) : Real(0);
  return t;
}

/// The two products that all phases share, at order n: w phi1 (and w phi0 for a sine) and the torque's.
template <bool sine, class Real>
inline void emf_and_torque(const Constants<Real>& c, const EmfPiece<Real>& piece, Expansion<Real>& out,
                           series::Coefficients<Real>& y0, series::Coefficients<Real>& y1, int n) {
  const Real ia = out.i[0][n], ib = out.i[1][n], ic = out.i[2][n];
  y0[n] = piece.alpha[0] * ia + piece.alpha[1] * ib + piece.alpha[2] * ic;
  y1[n] = piece.beta[0] * ia + piece.beta[1] * ib + piece.beta[2] * ic;
  Real w0, w1;
  if constexpr (sine) {
    w0 = series::product_term(out.w, out.phi0, n);
    w1 = series::product_term(out.w, out.phi1, n);
    out.torque[n] = c.K_e * (series::product_term(out.phi0, y0, n) + series::product_term(out.phi1, y1, n));
    const Real f = out.h * c.pole_pairs / static_cast<Real>(n + 1);
    out.phi0[n + 1] = -f * w1;  // (cos x)' = -p w sin x
    out.phi1[n + 1] = f * w0;
  } else {
    w0 = out.w[n];
    w1 = series::product_term(out.w, out.x, n);
    out.torque[n] = c.K_e * (y0[n] + series::product_term(out.x, y1, n));
  }
  for (int k = 0; k < 3; ++k) out.emf[k][n] = c.K_e * (piece.alpha[k] * w0 + piece.beta[k] * w1);
}

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
      out.emf[k][j] *= factor;
      out.pole[k][j] *= factor;
    }
    out.w[j] *= factor;
    out.x[j] *= factor;
    out.bus[j] *= factor;
    out.torque[j] *= factor;
    out.phi0[j] *= factor;
    out.phi1[j] *= factor;
  }
  out.h *= half;
}

template <bool sine, class Real>
void recurrence(const Constants<Real>& c, const State<Real>& state, const Mode& mode, Expansion<Real>& out) {
  const EmfPiece<Real>& piece = c.emf[sector_in_turn(state.sector)].piece[mode.piece];
  const LegTerms<Real> t = leg_terms<Real>(mode.legs, c.devices);
  const bool turns = mode.motion != Motion::locked && mode.motion != Motion::stuck;
  const Real drag = c.load + (mode.motion == Motion::forward    ? c.coulomb
                              : mode.motion == Motion::backward ? -c.coulomb
                                                                : Real(0));
  const Real feed = mode.source_feeds ? c.inv_R_b : Real(0);
  series::Coefficients<Real> y0, y1;
  for (int k = 0; k < 3; ++k) out.i[k][0] = state.i[k];
  out.w[0] = turns ? state.w : Real(0);
  out.x[0] = state.x;
  out.bus[0] = state.bus;
  // Rounding level of the increments: well below the last bit of each state's natural scale.
  constexpr Real tiny = Real(1) / (Real(1LL << 57) * (sizeof(Real) > 8 ? 2048 : 1));
  const Real i_limit = 1 / (c.amp_scale * tiny), w_limit = 1 / (c.speed_scale * tiny);
  Real before = 0, last = 0;
  int n = 0;
  for (;;) {
    emf_and_torque<sine>(c, piece, out, y0, y1, n);
    const Real f = out.h / static_cast<Real>(n + 1);
    const Real unit = n == 0 ? Real(1) : Real(0);
    PerLeg<Real> v;
    for (int k = 0; k < 3; ++k)
      v[k] = t.on[k] * (t.share[k] * out.bus[n] + t.offset[k] * unit - t.r[k] * out.i[k][n] - out.emf[k][n]);
    const Real u_n = (v[0] + v[1] + v[2]) * t.inv_count;
    for (int k = 0; k < 3; ++k) {
      out.pole[k][n] = u_n + out.emf[k][n];
      out.i[k][n + 1] = f * c.inv_L * t.on[k] * (v[k] - u_n - c.R * out.i[k][n]);
    }
    out.w[n + 1] = turns ? f * c.inv_J * (out.torque[n] - c.B * out.w[n] - drag * unit) : Real(0);
    out.x[n + 1] = f * c.pole_pairs * out.w[n];
    out.bus[n + 1] = f * c.inv_C *
                     (feed * (c.V_0 * unit - out.bus[n]) -
                      (t.high[0] * out.i[0][n] + t.high[1] * out.i[1][n] + t.high[2] * out.i[2][n]));
    ++n;
    before = last;
    last = (abs(out.i[0][n]) + abs(out.i[1][n]) + abs(out.i[2][n])) * i_limit + abs(out.w[n]) * w_limit +
           abs(out.bus[n]) * i_limit * c.amp_scale / c.volt_scale;
    if (n >= 3 && last < 1 && before < 1) break;
    if (n == series::max_degree) break;
  }
  out.degree = n;
  for (int k = 0; k < 3; ++k) out.emf[k][n] = out.pole[k][n] = 0;  // one order less is known, and enough
  out.torque[n] = 0;
  if (last > 1 || before > 1) shorten(out, last, before);
}

}  // namespace detail

/// Expands the state in the given mode over `wanted` seconds, or over as much of it as full accuracy allows.
template <class Real>
void expand(const Constants<Real>& c, const State<Real>& state, const Mode& mode, Real wanted,
            Expansion<Real>& out) {
  out.h = wanted;
  if (c.sine) {
    out.phi0[0] = static_cast<Real>(base::cos(static_cast<double>(state.x)));
    out.phi1[0] = static_cast<Real>(base::sin(static_cast<double>(state.x)));
    detail::recurrence<true>(c, state, mode, out);
  } else {
    detail::recurrence<false>(c, state, mode, out);
  }
}

/// A cap on the length, so that few expansions are thrown away: half of the fastest time constant present.
template <class Real>
Real useful_length(const Constants<Real>& c, const State<Real>& state) {
  const Real electrical = (c.R + Real(c.devices.R_on_ohm) + Real(c.devices.r_d_ohm)) * c.inv_L;
  const Real bus = c.inv_C * (c.inv_R_b + c.amp_scale / c.volt_scale);
  return Real(0.5) /
         (electrical + bus + c.pole_pairs * detail::abs(state.w) + c.K_e * std::sqrt(c.inv_L * c.inv_J));
}

}  // namespace sixstep::plant
