// SPDX-License-Identifier: Apache-2.0
// Voltage of a floating terminal, u_n + e_k (model.md 2), over a segment. In few segments a terminal is near
// a rail. The series of the voltage is therefore computed only if a cheap bound does not exclude a crossing.
#pragma once
#include "sixstep/plant/recurrences.hpp"
#include "sixstep/series/first_root.hpp"

namespace sixstep::plant {

/// Coefficients of a floating terminal's voltage as a sum of the other series. If no leg is connected, the
/// voltage is e_k.
template <class Real>
struct PoleLaw {
  Real bus = 0, offset = 0, i = 0, w0 = 0, w1 = 0;  ///< coefficients of U_s, 1, i of `leg`, w phi0 and w phi1
  int leg = 0;
};

/// Coefficients for the floating leg k, with zero, one or two connected legs. The star point's voltage u_n is
/// the mean of u_s - e_s over the connected legs s.
template <class Real>
[[gnu::always_inline]] inline PoleLaw<Real> pole_law(const EmfPiece<Real>& p, const LegsLaw<Real>& law,
                                                     unsigned k) {
  if (law.connected == 0) return {.w0 = p.alpha[k], .w1 = p.beta[k]};
  const int j = law.leg[0];
  // mutant: law.connected == 2 => true
  const bool pair = law.connected == 2;
  return {.bus = law.star.bus,
          .offset = law.star.offset,
          .i = law.star.i,
          .w0 = pair ? p.alpha_above[k] : p.alpha[k] - p.alpha[j],
          .w1 = pair ? p.beta_above[k] : p.beta[k] - p.beta[j],
          .leg = j};
}

/// Voltage, V, of the floating terminal at bus voltage `bus`, currents i and speed w. phi0 and phi1 are the
/// shape functions of back_emf.hpp.
template <class Real>
[[gnu::always_inline]] inline Real free_voltage(const PoleLaw<Real>& law, Real bus, const PerLeg<Real>& i,
                                                Real w, Real phi0, Real phi1) {
  return (law.bus * bus + law.offset) + (law.i * i[law.leg] + w * (law.w0 * phi0 + law.w1 * phi1));
}

/// Bounds of a floating terminal's voltage, computed without its series: value and slope at the segment's
/// start, and a bound of the sum of all later terms. `bus_rest` is the bound of the later terms of U_s.
template <class Real>
struct PoleOutline {
  Real start = 0, slope = 0, rest = 0;
};

template <class Real>
[[gnu::always_inline]] inline PoleOutline<Real> pole_outline(const Constants<Real>& c,
                                                             const Expansion<Real>& y,
                                                             const PoleLaw<Real>& law, Real bus_rest) {
  using detail::abs;
  const Real w = y.w[0], x = y.x[0], reach_w = y.reach_w, reach_x = y.reach_x;
  const Real phi0 = c.sine ? y.phi0[0] : Real(1), phi1 = c.sine ? y.phi1[0] : x;
  PoleOutline<Real> out;
  out.start = free_voltage(law, y.bus[0], {y.i[0][0], y.i[1][0], y.i[2][0]}, w, phi0, phi1);
  if (c.sine) {  // bound of |w phi - (w phi)(0)| by the product rule; phi0 and phi1 change at most as much as
                 // x
    // mutant: (abs(w) + reach_w) * reach_x + reach_w => reach_w
    out.rest = (abs(law.w0) + abs(law.w1)) * ((abs(w) + reach_w) * reach_x + reach_w);
  } else {
    const Real later_w = reach_w - abs(y.w[1]);
    out.slope = law.w0 * y.w[1] + law.w1 * (y.w[1] * x + w * y.x[1]);
    out.rest =
        // mutant: abs(x) * later_w + abs(w) * y.later_x + reach_w * reach_x => abs(x) * later_w
        abs(law.w0) * later_w + abs(law.w1) * (abs(x) * later_w + abs(w) * y.later_x + reach_w * reach_x);
  }
  if (law.i != 0) {
    const Real first = y.i[law.leg][1];
    out.slope += law.i * first;
    out.rest += abs(law.i) * (y.reach_i[law.leg] - abs(first));
  }
  out.slope += law.bus * y.bus[1];
  out.rest += abs(law.bus) * bus_rest;
  return out;
}

template <class Real>
series::Coefficients<Real> pole_series(const Constants<Real>& c, const Expansion<Real>& y,
                                       const PoleLaw<Real>& law) {
  series::Coefficients<Real> u;
  for (int n = 0; n <= y.degree; ++n) {
    const Real w0 = c.sine ? series::product_term(y.w, y.phi0, n) : y.w[n];
    const Real w1 = series::product_term(y.w, c.sine ? y.phi1 : y.x, n);
    u[n] = law.bus * y.bus[n] + law.i * y.i[law.leg][n] + law.w0 * w0 + law.w1 * w1;
  }
  u[0] += law.offset;
  return u;
}

}  // namespace sixstep::plant
