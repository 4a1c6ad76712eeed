// SPDX-License-Identifier: Apache-2.0
// A speed controller by sliding mode with an integral surface (Utkin and Shi, Integral sliding mode in systems operating
// under uncertainty conditions, CDC 1996) and a boundary layer (Slotine and Li, Applied Nonlinear Control, 7.2):
//
//   m[n+1] = m[n] + q (r - y),   s = m - y,   u = (q/b) (r - y) + R sat(s/P)
//
// m is the speed that a drive without load would have, an error e of which each sample leaves (1 - q) e; it begins where
// the speed is, so that a setpoint is followed on the surface from the first sample on. b is what a sample of full torque
// adds to the speed, l the load in parts of it. Then, short of the limit,
//
//   |s| > P   s moves by b (R - l) a sample: from s_0 the layer is reached after (|s_0| - P)/(b (R - l)) samples
//   |s| < P   s[n+1] = (1 - b R/P) s[n] + b l: it rests at P l/R, where R sat(s/P) is the load, and y = r
//
// At a limit m is moved to where u is just that limit, as far as the layer goes, and outside of the layer it goes no
// further from the speed: nothing winds up.
//
// Floating point only: of fixed point nothing is proved.
#pragma once
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

/// Defaults give no output at all.
template <class Scalar>
struct SlidingSpeedConfig {
  Scalar q{};      ///< of the error, that a sample takes away
  Scalar f{};      ///< q/b, output per rad/s
  Scalar reach{};  ///< R, the load that it bears, of the torque limit
  Scalar layer{};  ///< P, rad/s
  bool operator==(const SlidingSpeedConfig&) const = default;
};

template <class Scalar>
struct SlidingSpeedState {
  Scalar m{};     ///< rad/s; before the first sample: the output to begin with
  Scalar held{};  ///< R sat(s/P), what would be the output at no error
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
