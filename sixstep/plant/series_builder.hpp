// SPDX-License-Identifier: Apache-2.0
// The parts of a segment's series that all conduction modes use: rotor, bus and shape of the back-EMF
// (model.md 1).
#pragma once
#include "sixstep/plant/torques.hpp"

namespace sixstep::plant::detail {

// The order n of a term is a template argument: the whole recurrence is unrolled, with the products of short
// series. An unrolled kernel needs a quarter of the time of a kernel with loops (model.md 12).

/// The series of a segment while the recurrence adds terms. This object is a local variable of the
/// recurrence, so that the newest terms stay in registers and no store delays them. Series that a conduction
/// mode does not use are not computed.
template <class Real>
struct SeriesBuilder {
  Real h;
  Real reach_w = 0, reach_i = 0, reach_i_2 = 0;               ///< sums of the terms' sizes
  Real later_w = 0, later_x = 0, later_i = 0, later_i_2 = 0;  ///< sums of the terms after the first
  series::Coefficients<Real> w, x, torque, bus;
  series::Coefficients<Real> i,
      i_2;  ///< current of the first leg; with three connected legs also of the second leg
  series::Coefficients<Real> phi0, phi1;  ///< cos x and sin x; used only for a sinusoidal back-EMF
};

/// The rotor's part of the recurrence, the same for every conduction mode.
template <class Real>
struct Rotor {
  Real inv_J;  ///< zero for a rotor at rest
  Real pole_pairs;
  Real steady, per_speed;  ///< torque against the rotation: constant part, N m, and part per speed, N m s

  Rotor(const Constants<Real>& c, Motion motion)
      // mutant: turns(motion) => motion != Motion::locked
      : inv_J(turns(motion) ? c.inv_J : Real(0)), pole_pairs(c.pole_pairs) {
    const auto [load, dry, B] = torques(c, motion);
    steady = load + dry;
    per_speed = B;
  }

  template <int n>
  void step(SeriesBuilder<Real>& y, Real f) const {
    Real losses = per_speed * y.w[n];
    if constexpr (n == 0) losses += steady;
    y.w[n + 1] = (y.torque[n] - losses) * (f * inv_J);
    y.x[n + 1] = f * pole_pairs * y.w[n];
  }
};

/// Computes term n of w cos x and w sin x, and term n + 1 of cos x and sin x, for a sinusoidal back-EMF.
template <int n, class Real>
inline void sine_products(const Rotor<Real>& rotor, SeriesBuilder<Real>& y, Real f, Real& w0, Real& w1) {
  w0 = series::product_term<n>(y.w, y.phi0);
  w1 = series::product_term<n>(y.w, y.phi1);
  // mutant: -f * rotor.pole_pairs * w1 => -f * w1
  y.phi0[n + 1] = -f * rotor.pole_pairs * w1;  // (cos x)' = -p w sin x
  y.phi1[n + 1] = f * rotor.pole_pairs * w0;
}

/// Back-EMF of a leg per speed: now + rise (x - x(0)) for a trapezoid, now cos x + rise sin x for a sine.
/// x(0) is the angle at the segment's start. In this form the newest terms are multiplied only by constants,
/// which shortens the longest chain of dependent operations.
template <bool sine, class Real>
struct ShapeLine {
  PerLeg<Real> now, rise;
  ShapeLine(const EmfPiece<Real>& p, Real x) : now(p.alpha), rise(p.beta) {
    if constexpr (!sine)
      for (int k = 0; k < 3; ++k) now[k] += p.beta[k] * x;
  }
};

/// Equation of the bus voltage U_s: C dU_s/dt = (V_0 - U_s)/R_b - i_dc. If the source does not feed, the
/// first term is 0. The bridge's current i_dc is a sum of currents of connected legs.
template <class Real>
struct BusLaw {
  Real inv_C, feed, V_0, dc_i, dc_i_2;

  BusLaw(const Constants<Real>& c, const Mode& mode, const LegsLaw<Real>& law)
      : inv_C(c.inv_C), feed(mode.source_feeds ? c.inv_R_b : Real(0)), V_0(c.V_0) {
    const auto high = [&](unsigned n) {
      return n < law.connected && is_high(mode.legs[law.leg[n]]) ? Real(1) : Real(0);
    };
    // mutant: high(0) - high(2) => high(0) - high(1)
    dc_i = law.connected == 3 ? high(0) - high(2) : high(0) - high(1);
    // mutant: high(1) - high(2) => high(1)
    dc_i_2 = law.connected == 3 ? high(1) - high(2) : Real(0);
  }
  template <int n>
  void step(SeriesBuilder<Real>& y, Real f, Real i, Real i_2) const {
    y.bus[n + 1] = f * inv_C * (feed * ((n == 0 ? V_0 : Real(0)) - y.bus[n]) - (dc_i * i + dc_i_2 * i_2));
  }
};

}  // namespace sixstep::plant::detail
