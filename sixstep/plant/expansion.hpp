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

/// The voltage of a floating terminal, u_n + e_k, as a law over the other series; where no leg is connected,
/// e_k alone. Only a few segments come near a rail, so its own series is made when asked for.
template <class Real>
struct PoleLaw {
  Real bus = 0, offset = 0, i = 0, w0 = 0, w1 = 0;  ///< per U_s, 1, i of `leg`, w phi0, w phi1
  int leg = 0;
};

/// Series over one segment.
template <class Real>
struct Expansion {
  int degree = 0;
  Real h = 0;                  ///< length in seconds
  Real inv_ph = 0;             ///< 1/(p h): w from the slope of x
  PerLeg<PoleLaw<Real>> pole;  ///< of floating legs
  PerLeg<series::Coefficients<Real>> i;
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
    for (int k = 0; k < 3; ++k) out.i[k][j] *= factor;
    for (series::Coefficients<Real>* c : {&out.w, &out.x, &out.bus, &out.torque, &out.phi0, &out.phi1})
      (*c)[j] *= factor;
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
    const Real losses = c.B * y.w[n] + (n == 0 ? drag : Real(0));
    y.w[n + 1] = turns ? (y.torque[n] - losses) * (f * c.inv_J) : Real(0);
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
    // w x = (x^2)'/2 over p h, and a square has half the products; x is one order ahead: x' = p h w.
    const Real next = f * c.pole_pairs * y.w[n];
    y.x[n + 1] = next;
    w1 = series::half_square_term<n + 1>(y.x) * (Real(n + 1) * y.inv_ph);
  }
}

/// Which legs are connected, in order; the rest float.
struct Split {
  std::array<std::uint8_t, 3> leg{};
  std::uint8_t connected = 0;
};

inline constexpr std::array<Split, 8> splits = [] {
  std::array<Split, 8> all{};
  for (unsigned mask = 0; mask < 8; ++mask) {
    Split& s = all[mask];
    std::uint8_t back = 3;
    for (std::uint8_t k = 3; k-- > 0;)
      if (!(mask >> k & 1)) s.leg[--back] = k;
    for (std::uint8_t k = 0; k < 3; ++k)
      if (mask >> k & 1) s.leg[s.connected++] = k;
  }
  return all;
}();

inline const Split& split_of(const Legs& legs) {
  return splits[unsigned{!is_floating(legs[0])} | unsigned{!is_floating(legs[1])} << 1 |
                unsigned{!is_floating(legs[2])} << 2];
}

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
  static constexpr bool sine_shape = sine;
  NoCurrent(const Constants<Real>& c, const Mode& mode, const Split& split, const EmfPiece<Real>& p,
            Expansion<Real>& y) {
    for (int k = 0; k < 3; ++k) y.pole[k] = {.w0 = c.K_e * p.alpha[k], .w1 = c.K_e * p.beta[k]};
    if (split.connected == 0) return;
    const int s = split.leg[0];
    const PoleTerms<Real>& terms = c.pole_terms[static_cast<std::size_t>(mode.legs[s])];
    for (int k = 0; k < 3; ++k)
      y.pole[k] = {.bus = terms.bus_share,
                   .offset = terms.offset_V,
                   .w0 = c.K_e * (p.alpha[k] - p.alpha[s]),
                   .w1 = c.K_e * (p.beta[k] - p.beta[s])};
  }
  template <int n, bool bus>
  void step(const Constants<Real>& c, Expansion<Real>& y, Order<n>, Real f) {
    if constexpr (sine) {
      Real w0, w1;
      shape_products<sine, n>(c, y, f, w0, w1);
    }
    for (int k = 0; k < 3; ++k) y.i[k][n + 1] = 0;
    y.torque[n] = 0;
  }
  Real size(const Expansion<Real>&, int) const { return 0; }
};

/// Two legs share one current: one recurrence. Coefficients are multiplied out beforehand and the newest
/// terms enter last: the orders follow from each other, so what counts is the length of that chain. `flat`:
/// both on their flat tops, where neither current nor torque needs a product.
template <bool sine, bool flat, class Real>
struct OneCurrent {
  static constexpr bool sine_shape = sine;
  int j, k, floating;
  Real from_bus, from_offset, from_i, from_w0,
      from_w1;              // di/dt, from 2 L di/dt = u_j - u_k - 2 R i - (e_j - e_k)
  Real torque_0, torque_1;  // per phi0 i and phi1 i

  OneCurrent(const Constants<Real>& c, const Mode& mode, const Split& split, const EmfPiece<Real>& p,
             Expansion<Real>& y)
      : j(split.leg[0]), k(split.leg[1]), floating(split.leg[2]) {
    const PoleTerms<Real>& a = c.pole_terms[static_cast<std::size_t>(mode.legs[j])];
    const PoleTerms<Real>& b = c.pole_terms[static_cast<std::size_t>(mode.legs[k])];
    const Real rate = c.inv_L / 2;
    from_bus = rate * (a.bus_share - b.bus_share);
    from_offset = rate * (a.offset_V - b.offset_V);
    from_i = rate * (2 * c.R + a.r_ohm + b.r_ohm);
    torque_0 = c.K_e * (p.alpha[j] - p.alpha[k]);
    torque_1 = c.K_e * (p.beta[j] - p.beta[k]);
    from_w0 = rate * torque_0;
    from_w1 = rate * torque_1;
    y.pole[floating] = {.bus = (a.bus_share + b.bus_share) / 2,
                        .offset = (a.offset_V + b.offset_V) / 2,
                        .i = (b.r_ohm - a.r_ohm) / 2,
                        .w0 = c.K_e * (p.alpha[floating] - (p.alpha[j] + p.alpha[k]) / 2),
                        .w1 = c.K_e * (p.beta[floating] - (p.beta[j] + p.beta[k]) / 2),
                        .leg = j};
  }
  template <int n, bool bus>
  void step(const Constants<Real>& c, Expansion<Real>& y, Order<n>, Real f) {
    Real w0 = y.w[n], w1 = 0;
    if constexpr (!flat) shape_products<sine, n>(c, y, f, w0, w1);
    const Real i = y.i[j][n];
    Real slope = -(from_i * i + from_w0 * w0);
    if constexpr (n == 0 || bus) slope += from_bus * y.bus[n] + (n == 0 ? from_offset : Real(0));
    if constexpr (!flat) slope -= from_w1 * w1;
    y.i[j][n + 1] = f * slope;
    y.i[k][n + 1] = -y.i[j][n + 1];
    y.i[floating][n + 1] = 0;
    if constexpr (sine)
      y.torque[n] = torque_0 * series::product_term<n>(y.phi0, y.i[j]) +
                    torque_1 * series::product_term<n>(y.phi1, y.i[j]);
    else if constexpr (flat)
      y.torque[n] = torque_0 * i;
    else
      y.torque[n] = torque_0 * i + torque_1 * series::product_term<n>(y.x, y.i[j]);
  }
  Real size(const Expansion<Real>& y, int n) const { return 2 * abs(y.i[j][n]); }
};

/// All three legs: two recurrences, the third current follows. Coefficients multiplied out as above, i_c
/// eliminated.
template <bool sine, class Real>
struct TwoCurrents {
  static constexpr bool sine_shape = sine;
  struct Slope {
    Real bus, offset, i_a, i_b, w0, w1;
  };
  Slope a, b;                                       // L di_k/dt = v_k - mean of v, v_k = u_k - R i_k - e_k
  Real torque_0a, torque_0b, torque_1a, torque_1b;  // per phi i_a, phi i_b
  series::Coefficients<Real> y0, y1;

  TwoCurrents(const Constants<Real>& c, const Mode& mode, const Split&, const EmfPiece<Real>& p,
              Expansion<Real>&) {
    PerLeg<Real> share, offset, R;
    for (int k = 0; k < 3; ++k) {
      const PoleTerms<Real>& t = c.pole_terms[static_cast<std::size_t>(mode.legs[k])];
      share[k] = t.bus_share;
      offset[k] = t.offset_V;
      R[k] = c.R + t.r_ohm;
    }
    const auto above_mean = [&](const PerLeg<Real>& v, int k) {
      return c.inv_L * (v[k] - (v[0] + v[1] + v[2]) * Real(1.0L / 3));
    };
    const auto slope = [&](int k) {
      const Real i_c = -c.inv_L * R[2] * Real(1.0L / 3);  // of the other two legs' share in the mean
      const auto own = [&](int m) {
        return c.inv_L * R[m] * ((m == k ? Real(1) : Real(0)) - Real(1.0L / 3));
      };
      return Slope{above_mean(share, k), above_mean(offset, k),          own(0) - i_c,
                   own(1) - i_c,         c.K_e * above_mean(p.alpha, k), c.K_e * above_mean(p.beta, k)};
    };
    a = slope(0);
    b = slope(1);
    torque_0a = c.K_e * (p.alpha[0] - p.alpha[2]);
    torque_0b = c.K_e * (p.alpha[1] - p.alpha[2]);
    torque_1a = c.K_e * (p.beta[0] - p.beta[2]);
    torque_1b = c.K_e * (p.beta[1] - p.beta[2]);
  }
  template <int n, bool bus>
  static Real rate(const Slope& s, const Expansion<Real>& y, Real w0, Real w1) {
    Real known = -((s.i_a * y.i[0][n] + s.i_b * y.i[1][n]) + s.w0 * w0);
    if constexpr (n == 0 || bus) known += s.bus * y.bus[n] + (n == 0 ? s.offset : Real(0));
    return known - s.w1 * w1;
  }
  template <int n, bool bus>
  void step(const Constants<Real>& c, Expansion<Real>& y, Order<n>, Real f) {
    Real w0, w1;
    shape_products<sine, n>(c, y, f, w0, w1);
    const Real i_a = y.i[0][n], i_b = y.i[1][n];
    y.i[0][n + 1] = f * rate<n, bus>(a, y, w0, w1);
    y.i[1][n + 1] = f * rate<n, bus>(b, y, w0, w1);
    y.i[2][n + 1] = -(y.i[0][n + 1] + y.i[1][n + 1]);
    y1[n] = torque_1a * i_a + torque_1b * i_b;
    y0[n] = torque_0a * i_a + torque_0b * i_b;
    if constexpr (sine)
      y.torque[n] = series::product_term<n>(y.phi0, y0) + series::product_term<n>(y.phi1, y1);
    else
      y.torque[n] = y0[n] + series::product_term<n>(y.x, y1);
  }
  Real size(const Expansion<Real>& y, int n) const {
    return abs(y.i[0][n]) + abs(y.i[1][n]) + abs(y.i[2][n]);
  }
};

/// How far the last two terms stand above the rounding level of their states, 1 = at it.
template <class Real>
struct Convergence {
  Real i_limit, w_limit, bus_limit;
  Real before = 0, last = 0;
  /// Well below the last bit of each state's natural scale, so that truncation never adds up.
  static constexpr Real per_scale = Real(1LL << 53) * (sizeof(Real) > 8 ? 2048 : 1);

  explicit Convergence(const Constants<Real>& c) {
    i_limit = per_scale / c.amp_scale;
    w_limit = per_scale / c.speed_scale;
    bus_limit = c.inv_C > 0 ? per_scale / c.volt_scale : Real(0);
  }
  /// A sine's shape counts too: without current it alone decides how far a floating terminal's voltage is
  /// known.
  template <bool sine, bool bus>
  void look(const Expansion<Real>& y, int n, Real currents) {
    before = last;
    last = currents * i_limit + abs(y.w[n]) * w_limit;
    if constexpr (bus) last += abs(y.bus[n]) * bus_limit;
    if constexpr (sine) last += (abs(y.phi0[n]) + abs(y.phi1[n])) * per_scale;
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
  currents.template step<n, bus>(c, y, Order<n>{}, f);
  rotor.step(c, y, Order<n>{}, f);
  if constexpr (bus)
    bus_step<n>(c, mode, y, f);
  else
    y.bus[n + 1] = 0;
  y.degree = n + 1;
  if constexpr (n < 3) return false;  // no segment worth taking needs fewer
  convergence.template look<Currents::sine_shape, bus>(y, n + 1, currents.size(y, n + 1));
  return convergence.reached();
}

/// Order by order until the last two terms are below rounding, or the degree is used up.
template <bool bus, class Currents, class Real>
void recurrence_with(const Constants<Real>& c, const Mode& mode, Currents& currents, Expansion<Real>& y) {
  const Rotor<Real> rotor(c, mode.motion);
  Convergence<Real> convergence(c);
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
  if (split.connected == 3)
    recurrence(c, mode, TwoCurrents<sine, Real>(c, mode, split, piece, y), y);
  else if (split.connected < 2)
    recurrence(c, mode, NoCurrent<sine, Real>(c, mode, split, piece, y), y);
  else if (!sine && piece.beta[split.leg[0]] == piece.beta[split.leg[1]])
    recurrence(c, mode, OneCurrent<sine, !sine, Real>(c, mode, split, piece, y), y);
  else
    recurrence(c, mode, OneCurrent<sine, false, Real>(c, mode, split, piece, y), y);
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
