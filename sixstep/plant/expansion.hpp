// SPDX-License-Identifier: Apache-2.0
// Constants contains the plant's parameters, Expansion the polynomials of one segment. Guards, recorded
// values and energies use the same polynomials, because between events the right-hand side is polynomial in
// the state (model.md 12).
#pragma once
#include <cmath>

#include "sixstep/plant/back_emf.hpp"
#include "sixstep/plant/legs_law.hpp"
#include "sixstep/plant/state.hpp"
#include "sixstep/series/polynomial.hpp"

namespace sixstep::plant {

/// Parameters in the form that the recurrence uses, and the scales that define rounding noise.
template <class Real>
struct Constants {
  Real R, inv_L, inv_J, B, pole_pairs, inv_pole_pairs, coulomb, breakaway;
  Real V_0, inv_R_b, inv_C;  // supply: voltage V_0, resistance R_b, capacitance C; inv_C = 0: stiff bus
  Real load = 0;             // load torque T_load in this segment
  Devices devices;
  PoleTable<Real> poles;
  LegsLaws<Real> legs;
  EmfTable<Real> emf;  // back-EMF shapes times K_e: V s, or N m/A
  bool sine = false, locked = false, dry_friction = false, source_sinks = true;
  Real volt_scale, amp_scale, speed_scale, torque_scale;
  Real volt_noise, amp_noise, speed_noise, torque_noise;  // noise_of() of the four scales
  Real steady_rate;                                       // constant part of the fastest rate, 1/s
  Real amp_limit, speed_limit, volt_limit;                // 1 divided by the size below which a term of the
                                                          // series counts as a rounding error
  Real K_e;
};

/// A term of a series counts as zero if it is smaller than the scale of its state divided by this number.
/// This threshold is far below the last bit, so that truncation errors do not accumulate.
template <class Real>
inline constexpr Real terms_per_scale = Real(1LL << 53) * (sizeof(Real) > 8 ? 2048 : 1);

/// Changes until a segment's end: currents of the first and second connected leg, A; speed, rad/s; angle,
/// electrical rad.
template <class Real>
struct Increments {
  Real i = 0, i_2 = 0, w = 0, x = 0;
};

/// Series over one segment, in powers of the fraction s of its length.
template <class Real>
struct Expansion {
  int degree = 0;
  Real h = 0;  ///< length in seconds
  PerLeg<series::Coefficients<Real>> i;
  series::Coefficients<Real> w, x, bus, torque;
  series::Coefficients<Real> phi0, phi1;  ///< cos x and sin x; used only for a sinusoidal back-EMF
  Increments<Real> end;
  PerLeg<Real> reach_i;  ///< bounds of the change of the currents, A, from the segment's start
  Real reach_w = 0, reach_x = 0;
  Real later_x = 0;  ///< bound of the change of x without its first term
};

namespace detail {

/// std::fabs is one instruction. A comparison would need a branch, because of the sign of zero.
template <class Real>
inline Real abs(Real v) {
  return std::fabs(v);
}

}  // namespace detail

}  // namespace sixstep::plant
