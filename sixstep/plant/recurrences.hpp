// SPDX-License-Identifier: Apache-2.0
// Structs that compute one order of the Taylor recurrence for the currents, one struct per number of
// connected legs (model.md 1 and 2).
#pragma once
#include "sixstep/plant/series_builder.hpp"

namespace sixstep::plant::detail {

/// Fewer than two legs are connected, so that no current flows. The rotor coasts, and guards check the
/// floating terminals.
template <bool sine, class Real>
struct NoCurrent {
  static constexpr bool sine_shape = sine;
  NoCurrent(const Rotor<Real>&, const Constants<Real>&, const LegsLaw<Real>&, const ShapeLine<sine, Real>&) {}
  void start(const Expansion<Real>&, SeriesBuilder<Real>& y) const { y.i[0] = y.i_2[0] = 0; }
  template <int n, bool bus>
  void step(const Rotor<Real>& rotor, SeriesBuilder<Real>& y, Real f) {
    if constexpr (sine) {
      Real w0, w1;
      sine_products<n>(rotor, y, f, w0, w1);
    }
    y.i[n + 1] = y.i_2[n + 1] = y.torque[n] = 0;
    rotor.template step<n>(y, f);
  }
  void write(Expansion<Real>& out, int n, const SeriesBuilder<Real>&) const {
    out.i[0][n] = out.i[1][n] = out.i[2][n] = 0;
  }
  Real reached(SeriesBuilder<Real>&, int) const { return 0; }
  void reach(const SeriesBuilder<Real>&, PerLeg<Real>& of) const { of = {}; }
};

/// Two connected legs have currents i and -i, so that one recurrence suffices. Each order depends on the
/// previous order, and the length of this chain determines the computing time. Therefore coefficients are
/// multiplied beforehand, and the newest terms are added last.
template <bool sine, class Real>
struct PairLaw {
  int j, k, floating;
  typename LegsLaw<Real>::Terms slope;
  Real from_w0, from_w1;    // coefficients of w phi0 and w phi1 in di/dt
  Real torque_0, torque_1;  // torque per phi0 i and per phi1 i

  PairLaw(const LegsLaw<Real>& law, const ShapeLine<sine, Real>& f)
      : j(law.leg[0]), k(law.leg[1]), floating(law.leg[2]), slope(law.slope) {
    torque_0 = f.now[j] - f.now[k];
    torque_1 = f.rise[j] - f.rise[k];
    from_w0 = -law.emf_rate * torque_0;
    from_w1 = -law.emf_rate * torque_1;
  }
  template <int n, bool bus>
  Real known(const SeriesBuilder<Real>& y, Real w0) const {
    Real sum = slope.i * y.i[n] + from_w0 * w0;
    if constexpr (n == 0 || bus) sum += slope.bus * y.bus[n];
    if constexpr (n == 0) sum += slope.offset;
    return sum;
  }
  void start(const Expansion<Real>& out, SeriesBuilder<Real>& y) const {
    y.i[0] = out.i[j][0];
    y.i_2[0] = 0;
  }
  void write(Expansion<Real>& out, int n, const SeriesBuilder<Real>& y) const {
    out.i[j][n] = y.i[n];
    out.i[k][n] = -y.i[n];
    out.i[floating][n] = 0;
  }
  /// Adds term n to the reach and to the sum of the series. Returns the size of the term, summed over all
  /// legs.
  Real reached(SeriesBuilder<Real>& y, int n) const {
    const Real size = abs(y.i[n]);
    y.reach_i += size;
    if (n > 1) y.later_i += y.i[n];
    return 2 * size;
  }
  void reach(const SeriesBuilder<Real>& y, PerLeg<Real>& of) const {
    of[j] = of[k] = y.reach_i;
    of[floating] = 0;
  }
};

template <bool sine, class Real>
struct OneCurrent {
  static constexpr bool sine_shape = sine;
  PairLaw<sine, Real> pair;
  Real from_square;  // w (x - x(0)) = ((x - x(0))^2)'/(2 p h); a square needs half the products

  OneCurrent(const Rotor<Real>&, const Constants<Real>& c, const LegsLaw<Real>& law,
             const ShapeLine<sine, Real>& f)
      // mutant: pair.from_w1 * c.inv_pole_pairs => pair.from_w1
      : pair(law, f), from_square(pair.from_w1 * c.inv_pole_pairs) {}
  void start(const Expansion<Real>& out, SeriesBuilder<Real>& y) const { pair.start(out, y); }
  void write(Expansion<Real>& out, int n, const SeriesBuilder<Real>& y) const { pair.write(out, n, y); }
  Real reached(SeriesBuilder<Real>& y, int n) const { return pair.reached(y, n); }
  void reach(const SeriesBuilder<Real>& y, PerLeg<Real>& of) const { pair.reach(y, of); }

  template <int n, bool bus>
  void step(const Rotor<Real>& rotor, SeriesBuilder<Real>& y, Real f) {
    const series::Coefficients<Real>& i = y.i;
    y.i_2[n + 1] = 0;
    if constexpr (sine) {
      Real w0, w1;
      sine_products<n>(rotor, y, f, w0, w1);
      y.i[n + 1] = f * (pair.template known<n, bus>(y, w0) + pair.from_w1 * w1);
      y.torque[n] = pair.torque_0 * series::product_term<n>(y.phi0, i) +
                    pair.torque_1 * series::product_term<n>(y.phi1, i);
    } else {
      y.i[n + 1] = f * pair.template known<n, bus>(y, y.w[n]);
      y.torque[n] = pair.torque_0 * i[n];
      if constexpr (n > 0) {
        y.i[n + 1] += from_square * series::half_increment_square_term<n + 1>(y.x);
        y.torque[n] += pair.torque_1 * series::increment_product_term<n>(y.x, i);
      }
    }
    rotor.template step<n>(y, f);
  }
};

/// Both connected phases are on their flat tops, and the torques are linear in the speed. Current i and speed
/// w are then a linear system, (i, w)' = M (i, w) + const. With M^2 each term follows from the term two
/// orders before, so that even and odd terms are two independent chains. If the bus voltage changes, the
/// single chain of PairLaw is used.
template <class Real>
struct FlatPair {
  static constexpr bool sine_shape = false;
  PairLaw<false, Real> pair;
  Real m_ii, m_iw, m_wi, m_ww;  // M^2

  FlatPair(const Rotor<Real>& rotor, const Constants<Real>&, const LegsLaw<Real>& law,
           const ShapeLine<false, Real>& f)
      : pair(law, f) {
    // M contains only the rotor terms that multiply i and w. The constant terms are part of order 1.
    [[maybe_unused]] const auto& [inv_J, pole_pairs, steady, per_speed] = rotor;
    const Real a = pair.slope.i, b = pair.from_w0;
    // mutant: -per_speed * inv_J => Real(0)
    const Real d = pair.torque_0 * inv_J, e = -per_speed * inv_J;
    m_ii = a * a + b * d;
    // mutant: a * b + b * e => a * b + b * a
    m_iw = a * b + b * e;
    m_wi = d * a + e * d;
    m_ww = d * b + e * e;
  }
  void start(const Expansion<Real>& out, SeriesBuilder<Real>& y) const { pair.start(out, y); }
  void write(Expansion<Real>& out, int n, const SeriesBuilder<Real>& y) const { pair.write(out, n, y); }
  Real reached(SeriesBuilder<Real>& y, int n) const { return pair.reached(y, n); }
  void reach(const SeriesBuilder<Real>& y, PerLeg<Real>& of) const { pair.reach(y, of); }
  template <int n, bool bus>
  void step(const Rotor<Real>& rotor, SeriesBuilder<Real>& y, Real f) {
    const series::Coefficients<Real>& i = y.i;
    y.i_2[n + 1] = 0;
    y.torque[n] = pair.torque_0 * i[n];
    if constexpr (n >= 2 && !bus) {
      // mutant: 1.0L / (n * (n + 1)) => 1.0L / ((n + 1) * (n + 2))
      const Real g = y.h * y.h * Real(1.0L / (n * (n + 1)));
      const Real next_w = g * (m_wi * i[n - 1] + m_ww * y.w[n - 1]);
      y.i[n + 1] = g * (m_ii * i[n - 1] + m_iw * y.w[n - 1]);
      y.x[n + 1] = f * rotor.pole_pairs * y.w[n];
      y.w[n + 1] = next_w;
    } else {
      y.i[n + 1] = f * pair.template known<n, bus>(y, y.w[n]);
      rotor.template step<n>(y, f);
    }
  }
};

/// All three legs are connected. Two recurrences compute i_a and i_b; i_c is -(i_a + i_b). Coefficients are
/// multiplied beforehand as in PairLaw.
template <bool sine, class Real>
struct TwoCurrents {
  static constexpr bool sine_shape = sine;
  struct Slope {
    typename LegsLaw<Real>::Terms terms;
    Real w0, w1;  // coefficients of w phi0 and w phi1
  };
  Slope a, b;
  Real torque_0a, torque_0b, torque_1a, torque_1b;  // torque per phi0 i_a, phi0 i_b, phi1 i_a, phi1 i_b
  series::Coefficients<Real> y0, y1;

  TwoCurrents(const Rotor<Real>&, const Constants<Real>& c, const LegsLaw<Real>& law,
              const ShapeLine<sine, Real>& f) {
    const Real mean_0 = (f.now[0] + f.now[1] + f.now[2]) * Real(1.0L / 3);
    const Real mean_1 = (f.rise[0] + f.rise[1] + f.rise[2]) * Real(1.0L / 3);
    // w (x - x(0)) = ((x - x(0))^2)'/(2 p h); a square needs half the products.
    const Real rate_1 = sine ? law.emf_rate : law.emf_rate * c.inv_pole_pairs;
    a = {law.slope, -law.emf_rate * (f.now[0] - mean_0), -rate_1 * (f.rise[0] - mean_1)};
    // mutant: f.rise[1] - mean_1 => f.rise[1]
    b = {law.slope_2, -law.emf_rate * (f.now[1] - mean_0), -rate_1 * (f.rise[1] - mean_1)};
    torque_0a = f.now[0] - f.now[2];
    torque_0b = f.now[1] - f.now[2];
    torque_1a = f.rise[0] - f.rise[2];
    // mutant: f.rise[1] - f.rise[2] => f.rise[1] - f.rise[0]
    torque_1b = f.rise[1] - f.rise[2];
  }
  void start(const Expansion<Real>& out, SeriesBuilder<Real>& y) const {
    y.i[0] = out.i[0][0];
    y.i_2[0] = out.i[1][0];
  }
  template <int n, bool bus>
  static Real known(const Slope& s, const SeriesBuilder<Real>& y, Real w0) {
    Real sum = (s.terms.i * y.i[n] + s.terms.i_2 * y.i_2[n]) + s.w0 * w0;
    if constexpr (n == 0 || bus) sum += s.terms.bus * y.bus[n];
    if constexpr (n == 0) sum += s.terms.offset;
    return sum;
  }
  template <int n, bool bus>
  void step(const Rotor<Real>& rotor, SeriesBuilder<Real>& y, Real f) {
    const Real i_a = y.i[n], i_b = y.i_2[n];
    if constexpr (sine) {
      Real w0, w1;
      sine_products<n>(rotor, y, f, w0, w1);
      y.i[n + 1] = f * (known<n, bus>(a, y, w0) + a.w1 * w1);
      y.i_2[n + 1] = f * (known<n, bus>(b, y, w0) + b.w1 * w1);
    } else {
      y.i[n + 1] = f * known<n, bus>(a, y, y.w[n]);
      y.i_2[n + 1] = f * known<n, bus>(b, y, y.w[n]);
      if constexpr (n > 0) {
        const Real square = series::half_increment_square_term<n + 1>(y.x);
        y.i[n + 1] += a.w1 * square;
        y.i_2[n + 1] += b.w1 * square;
      }
    }
    y1[n] = torque_1a * i_a + torque_1b * i_b;
    const Real now = torque_0a * i_a + torque_0b * i_b;
    if constexpr (sine) {
      y0[n] = now;
      y.torque[n] = series::product_term<n>(y.phi0, y0) + series::product_term<n>(y.phi1, y1);
    } else {
      y.torque[n] = now;
      if constexpr (n > 0) y.torque[n] += series::increment_product_term<n>(y.x, y1);
    }
    rotor.template step<n>(y, f);
  }
  void write(Expansion<Real>& out, int n, const SeriesBuilder<Real>& y) const {
    out.i[0][n] = y.i[n];
    out.i[1][n] = y.i_2[n];
    out.i[2][n] = -(y.i[n] + y.i_2[n]);
  }
  Real reached(SeriesBuilder<Real>& y, int n) const {
    const Real size = abs(y.i[n]), size_2 = abs(y.i_2[n]);
    y.reach_i += size;
    y.reach_i_2 += size_2;
    if (n > 1) {
      y.later_i += y.i[n];
      y.later_i_2 += y.i_2[n];
    }
    return 2 * (size + size_2);
  }
  void reach(const SeriesBuilder<Real>& y, PerLeg<Real>& of) const {
    // mutant: y.reach_i + y.reach_i_2 => y.reach_i_2
    of = {y.reach_i, y.reach_i_2, y.reach_i + y.reach_i_2};
  }
};

}  // namespace sixstep::plant::detail
