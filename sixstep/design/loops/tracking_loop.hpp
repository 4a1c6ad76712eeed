// SPDX-License-Identifier: Apache-2.0
// Computes the gains of a tracking loop of type 2 (control/sensing/tracking.hpp) from its bandwidth w_b and
// damping D. In continuous time the loop follows an angle with
//
//   H(s) = (2 D w_n s + w_n^2)/(s^2 + 2 D w_n s + w_n^2),   w_b = w_n sqrt(1 + 2 D^2 + sqrt((1 + 2 D^2)^2 + 1))
//
// where |H(j w_b)| = 1/sqrt 2. Its poles s are mapped to z = exp(s T): sampling with the period T then
// changes neither frequency nor damping:
//
//   1 - K_p = z_1 z_2 = exp(-2 D w_n T),   2 - K_p - K_i = z_1 + z_2 = 2 exp(-D w_n T) cos(w_n T sqrt(1 - D^2))
//
// The poles are inside the unit circle for any period. Gains copied from continuous time, K_p = 2 D w_n T and
// K_i = (w_n T)^2, are unstable from w_n T = 2 (sqrt(1 + D^2) - D) on, by Jury's 2 K_p + K_i < 4.
#pragma once
#include "sixstep/base/result.hpp"
#include "sixstep/control/sensing/tracking.hpp"

namespace sixstep::design {

struct TrackingSpec {
  double bandwidth_rad_s = 0.0;  ///< w_b; electrical or mechanical, like the tracked angle
  double damping = 1.0;          ///< D, damping of the loop
  double period_s = 0.0;         ///< T, period of the loop
};

struct TrackingDesign {
  double K_p = 0.0, K_i = 0.0;
  double natural_rad_s = 0.0;     ///< w_n, natural frequency of the loop
  double K_a_per_s2 = 0.0;        ///< K_i/T^2: acceleration divided by the constant error that it causes
  double speed_rad_s_unit = 0.0;  ///< rad/s of one unit of control::tracking_speed(), 2 pi/(2^32 T)
};

/// Computes the gains. Problems: values not above 0, and a bandwidth of half the sampling frequency or more.
base::Result<TrackingDesign> tracking_loop(const TrackingSpec& spec);

/// True if the sampled loop is stable (Jury).
constexpr bool tracking_is_stable(double K_p, double K_i) {
  return K_p > 0 && K_p < 2 && K_i > 0 && 2 * K_p + K_i < 4;
}

/// The largest w_n T at which gains copied from continuous time are stable.
double taken_over_limit(double damping);

/// The gains in the chip's number format.
control::TrackingConfig tracking_config(const TrackingDesign& design);

}  // namespace sixstep::design
