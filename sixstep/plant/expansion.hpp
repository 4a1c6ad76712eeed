// SPDX-License-Identifier: Apache-2.0
// What the plant is made of in numbers, and the polynomials of one segment: between events the right-hand
// side is polynomial in the state, so guards, dense output and energy all read the same series (ENGINE).
#pragma once
#include <cmath>

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
  Real steady_rate;                         // the part of the fastest rate that does not change, 1/s
  Real amp_limit, speed_limit, volt_limit;  // 1 / rounding level of a term of the series
};

/// A term of a series is nothing once it is this many times smaller than its state's natural scale: well
/// below the last bit, so that truncation never adds up.
template <class Real>
inline constexpr Real terms_per_scale = Real(1LL << 53) * (sizeof(Real) > 8 ? 2048 : 1);

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

}  // namespace detail

}  // namespace sixstep::plant
