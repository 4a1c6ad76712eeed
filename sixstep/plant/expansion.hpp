// SPDX-License-Identifier: Apache-2.0
// Constants holds the plant's numbers, Expansion the polynomials of one segment. Guards, recorded values and
// energy read the same series, because the right-hand side is polynomial in the state between events
// (model.md 12).
#pragma once
#include <cmath>

#include "sixstep/plant/back_emf.hpp"
#include "sixstep/plant/legs_law.hpp"
#include "sixstep/plant/state.hpp"
#include "sixstep/series/polynomial.hpp"

namespace sixstep::plant {

/// Parameters as the recurrence wants them, and the scales that say what rounding noise is.
template <class Real>
struct Constants {
  Real R, inv_L, inv_J, B, pole_pairs, inv_pole_pairs, coulomb, breakaway;
  Real V_0, inv_R_b, inv_C;  // inv_C = 0: stiff bus
  Real load = 0;             // T_load at present
  Devices devices;
  PoleTable<Real> poles;
  LegsLaws<Real> legs;
  EmfTable<Real> emf;  // times K_e: V s, or N m/A
  bool sine = false, locked = false, dry_friction = false, source_sinks = true;
  Real volt_scale, amp_scale, speed_scale, torque_scale;
  Real volt_noise, amp_noise, speed_noise, torque_noise;  // noise_of() these scales
  Real steady_rate;                         // the part of the fastest rate that does not change, 1/s
  Real amp_limit, speed_limit, volt_limit;  // 1 / rounding level of a term of the series
  Real K_e;
};

/// A term of a series is nothing once it is this many times smaller than its state's natural scale: well
/// below the last bit, so that truncation never adds up.
template <class Real>
inline constexpr Real terms_per_scale = Real(1LL << 53) * (sizeof(Real) > 8 ? 2048 : 1);

/// What moves until a segment's end; currents of the first and second connected leg.
template <class Real>
struct Increments {
  Real i = 0, i_2 = 0, w = 0, x = 0;
};

/// Series over one segment.
template <class Real>
struct Expansion {
  int degree = 0;
  Real h = 0;  ///< length in seconds
  PerLeg<series::Coefficients<Real>> i;
  series::Coefficients<Real> w, x, bus, torque;
  series::Coefficients<Real> phi0, phi1;  ///< sine only: cos x, sin x
  Increments<Real> end;
  PerLeg<Real> reach_i;  ///< no series moves further from its first value than this
  Real reach_w = 0, reach_x = 0;
  Real later_x = 0;  ///< the same of x without its first term
};

namespace detail {

/// One instruction; written as a comparison it would cost a branch, to keep the sign of zero.
template <class Real>
inline Real abs(Real v) {
  return std::fabs(v);
}

}  // namespace detail

}  // namespace sixstep::plant
