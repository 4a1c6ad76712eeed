// SPDX-License-Identifier: Apache-2.0
// One order of the Taylor recurrence, in parts: the rotor, the bus, the shape products that all phases share,
// and the currents for each number of connected legs (MODEL 1 and 2).
#pragma once
#include <cstdint>

#include "sixstep/plant/expansion.hpp"

namespace sixstep::plant::detail {

// The order n of a term is a template argument: the whole recurrence is unrolled, products of short series
// included (ENGINE: an unrolled kernel takes a quarter of the time of one with counted loops).

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
  void step(const Constants<Real>& c, Expansion<Real>& y, Real f) const {
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
  void step(const Constants<Real>& c, const Rotor<Real>& rotor, Expansion<Real>& y, Real f) {
    if constexpr (sine) {
      Real w0, w1;
      shape_products<sine, n>(c, y, f, w0, w1);
    }
    for (int k = 0; k < 3; ++k) y.i[k][n + 1] = 0;
    y.torque[n] = 0;
    rotor.template step<n>(c, y, f);
  }
  Real size(const Expansion<Real>&, int) const { return 0; }
};

/// Two legs share one current: one recurrence. Coefficients are multiplied out beforehand and the newest
/// terms enter last: the orders follow from each other, so what counts is the length of that chain.
template <class Real>
struct PairLaw {
  int j, k, floating;
  Real from_bus, from_offset, from_i, from_w0,
      from_w1;              // di/dt, from 2 L di/dt = u_j - u_k - 2 R i - (e_j - e_k)
  Real torque_0, torque_1;  // per phi0 i and phi1 i

  PairLaw(const Constants<Real>& c, const Mode& mode, const Split& split, const EmfPiece<Real>& p,
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
  void write(Expansion<Real>& y, int n, Real i) const {
    y.i[j][n] = i;
    y.i[k][n] = -i;
    y.i[floating][n] = 0;
  }
  Real size(const Expansion<Real>& y, int n) const { return 2 * abs(y.i[j][n]); }
};

template <bool sine, class Real>
struct OneCurrent {
  static constexpr bool sine_shape = sine;
  PairLaw<Real> pair;

  OneCurrent(const Constants<Real>& c, const Mode& mode, const Split& split, const EmfPiece<Real>& p,
             Expansion<Real>& y)
      : pair(c, mode, split, p, y) {}
  Real size(const Expansion<Real>& y, int n) const { return pair.size(y, n); }

  template <int n, bool bus>
  void step(const Constants<Real>& c, const Rotor<Real>& rotor, Expansion<Real>& y, Real f) {
    Real w0, w1;
    shape_products<sine, n>(c, y, f, w0, w1);
    const series::Coefficients<Real>& i = y.i[pair.j];
    Real slope = -(pair.from_i * i[n] + pair.from_w0 * w0);
    if constexpr (n == 0 || bus) slope += pair.from_bus * y.bus[n] + (n == 0 ? pair.from_offset : Real(0));
    pair.write(y, n + 1, f * (slope - pair.from_w1 * w1));
    if constexpr (sine)
      y.torque[n] = pair.torque_0 * series::product_term<n>(y.phi0, i) +
                    pair.torque_1 * series::product_term<n>(y.phi1, i);
    else
      y.torque[n] = pair.torque_0 * i[n] + pair.torque_1 * series::product_term<n>(y.x, i);
    rotor.template step<n>(c, y, f);
  }
};

/// Both connected phases on their flat tops: current and speed are a linear system of two, (i, w)' = M (i, w)
/// + const, free of products. Its terms come two orders at a time from M^2, so that even and odd ones are two
/// chains side by side. A bus that moves joins the chain of the plain form.
template <class Real>
struct FlatPair {
  static constexpr bool sine_shape = false;
  PairLaw<Real> pair;
  Real m_ii, m_iw, m_wi, m_ww;  // M^2

  FlatPair(const Constants<Real>& c, const Mode& mode, const Split& split, const EmfPiece<Real>& p,
           Expansion<Real>& y)
      : pair(c, mode, split, p, y) {
    const bool turns = mode.motion != Motion::locked && mode.motion != Motion::stuck;
    const Real a = -pair.from_i, b = -pair.from_w0;
    const Real d = turns ? pair.torque_0 * c.inv_J : Real(0), e = turns ? -c.B * c.inv_J : Real(0);
    m_ii = a * a + b * d;
    m_iw = a * b + b * e;
    m_wi = d * a + e * d;
    m_ww = d * b + e * e;
  }
  Real size(const Expansion<Real>& y, int n) const { return pair.size(y, n); }
  template <int n, bool bus>
  void step(const Constants<Real>& c, const Rotor<Real>& rotor, Expansion<Real>& y, Real f) {
    const series::Coefficients<Real>& i = y.i[pair.j];
    y.torque[n] = pair.torque_0 * i[n];
    if constexpr (n >= 2 && !bus) {
      const Real g = y.h * y.h * Real(1.0L / (n * (n + 1)));
      const Real next_w = g * (m_wi * i[n - 1] + m_ww * y.w[n - 1]);
      pair.write(y, n + 1, g * (m_ii * i[n - 1] + m_iw * y.w[n - 1]));
      y.x[n + 1] = f * c.pole_pairs * y.w[n];
      y.w[n + 1] = next_w;
    } else {
      Real slope = -(pair.from_i * i[n] + pair.from_w0 * y.w[n]);
      if constexpr (n == 0 || bus) slope += pair.from_bus * y.bus[n] + (n == 0 ? pair.from_offset : Real(0));
      pair.write(y, n + 1, f * slope);
      rotor.template step<n>(c, y, f);
    }
  }
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
  void step(const Constants<Real>& c, const Rotor<Real>& rotor, Expansion<Real>& y, Real f) {
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
    rotor.template step<n>(c, y, f);
  }
  Real size(const Expansion<Real>& y, int n) const {
    return abs(y.i[0][n]) + abs(y.i[1][n]) + abs(y.i[2][n]);
  }
};

}  // namespace sixstep::plant::detail
