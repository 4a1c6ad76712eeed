// SPDX-License-Identifier: Apache-2.0
// Controls the speed by sliding mode with an integral surface (Utkin and Shi, Integral sliding mode in systems
// operating under uncertainty conditions, CDC 1996) and a boundary layer (Slotine and Li, Applied Nonlinear
// Control, 7.2):
//
//   m[n+1] = m[n] + q (r - y),   s = m - y,   u = (q/b) (r - y) + R sat(s/P)
//
// r is the setpoint, y the measured speed. m is the speed of an ideal drive without load. Each sample reduces
// the error r - m of this drive to the fraction 1 - q. m begins at the measured speed, so that the drive is
// on the surface s = 0 from the first sample on. R and P are constants of SlidingSpeedConfig. b is the speed
// that full torque adds in a sample, and l the load as a fraction of full torque. Inside the limit
//
//   |s| > P   s changes by b (R - l) per sample: s reaches the layer from s_0 after (|s_0| - P)/(b (R - l))
//             samples
//   |s| < P   s[n+1] = (1 - b R/P) s[n] + b l: s settles at P l/R: R sat(s/P) equals the load, and y = r
//
// At a limit of u, m changes so that u is exactly the limit, as far as the layer allows. Outside of the layer
// the distance of m from the speed does not increase, so that m does not wind up.
//
// This law exists in floating point only: its scaling in fixed point is not proved.
#pragma once
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

/// Default: the output is 0.
template <class Scalar>
struct SlidingSpeedConfig {
  Scalar q{};      ///< fraction by which each sample reduces the error
  Scalar f{};      ///< q/b, output per rad/s
  Scalar reach{};  ///< R, the largest load that the law compensates, as a fraction of the torque limit
  Scalar layer{};  ///< P, half the width of the boundary layer, rad/s
  bool operator==(const SlidingSpeedConfig&) const = default;
};

template <class Scalar>
struct SlidingSpeedState {
  Scalar m{};     ///< m, rad/s; before the first sample: the initial output
  Scalar held{};  ///< R sat(s/P), the output at zero error
  bool started = false;
};

template <class Scalar>
constexpr Scalar sliding_speed_step(const SlidingSpeedConfig<Scalar>& config,
                                    SlidingSpeedState<Scalar>& state, Scalar error, Scalar speed_rad_s,
                                    Scalar low, Scalar high) {
  if (!(config.layer > Scalar{}) || !(config.reach > Scalar{})) return Scalar{};
  const Scalar steepness = config.reach / config.layer;
  if (!state.started) state.m = speed_rad_s + clamped(state.m, config.reach) / steepness;
  state.started = true;
  const Scalar s = state.m - speed_rad_s, straight = config.f * error;
  state.held = clamped(steepness * s, config.reach);
  const Scalar v = straight + state.held, u = between(v, low, high);
  if (u != v) {
    state.held = clamped(u - straight, config.reach);
    state.m = speed_rad_s + state.held / steepness;
  }
  if (u != v || magnitude(s) <= config.layer || (s < Scalar{}) != (error < Scalar{}))
    state.m = state.m + config.q * error;
  return u;
}

}  // namespace sixstep::control
