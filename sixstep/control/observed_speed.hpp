// SPDX-License-Identifier: Apache-2.0
// A speed controller that observes speed and load and feeds both back. Its model of a sample, in fractions of the torque
// limit: the torque t follows what is asked for, u, by a lag, and a load l stands that nobody measures,
//
//   t[n] = c t[n-1] + (1 - c) u[n],   w[n+1] = a w[n] + b (t[n] - l)
//
// The observer corrects what it foretold by the speed that is measured, in current form (Franklin, Powell and Workman,
// Digital Control of Dynamic Systems, 8.2.2), and the controller asks for what holds its setpoint r and for a share of
// what is missing:
//
//   e = y - w[n|n-1],   w[n|n] = w[n|n-1] + L_w e,   l[n] = l[n-1] - L_l e
//   u_r = l + f r,      u = u_r + K (r - w[n|n] + g (u_r - t[n-1]))
//
// g is the speed that the torque still on its way will bring: w + g t behaves as if there were no lag
// (design/loops/speed_laws.hpp). The load is the integral: at rest y = r whatever it is. The observer is told the u that
// the limit leaves, so that nothing winds up.
//
// With c = f = g = 0 and a = 1 it is linear active disturbance rejection (Gao, Scaling and bandwidth-parameterization
// based controller tuning, ACC 2003; current form: Miklosovic, Radke and Gao, ACC 2006): b_0 = b/T, z_2 = -b_0 l, friction
// and whatever else the model lacks are part of l.
//
// Floating point only: of fixed point nothing is proved.
#pragma once
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

/// Defaults give no output at all.
template <class Scalar>
struct ObservedSpeedConfig {
  Scalar a{};    ///< what a sample leaves of the speed
  Scalar b{};    ///< rad/s that a sample of full torque adds
  Scalar c{};    ///< what a sample leaves of a torque that is not asked for any more
  Scalar L_w{};  ///< correction of the speed
  Scalar L_l{};  ///< correction of the load, per rad/s
  Scalar K{};    ///< output per rad/s
  Scalar f{};    ///< output per rad/s: what friction takes
  Scalar g{};    ///< rad/s per output: what is on its way
  bool operator==(const ObservedSpeedConfig&) const = default;
};

template <class Scalar>
struct ObservedSpeedState {
  Scalar w{};            ///< foretold for the next sample, rad/s
  Scalar l{};            ///< load, of the torque limit; before the first sample: the output to begin with
  Scalar t{};            ///< torque, of the torque limit
  bool started = false;  ///< the first sample is where the observer begins
};

template <class Scalar>
constexpr Scalar observed_speed_step(const ObservedSpeedConfig<Scalar>& config,
                                     ObservedSpeedState<Scalar>& state, Scalar error, Scalar speed_rad_s,
                                     Scalar low, Scalar high) {
  if (!state.started) {
    state.w = speed_rad_s;
    state.t = state.l;
    state.l = state.l - config.f * speed_rad_s;
    state.started = true;
  }
  const Scalar setpoint = error + speed_rad_s, missed = speed_rad_s - state.w;
  const Scalar w = state.w + config.L_w * missed;
  state.l = state.l - config.L_l * missed;
  const Scalar holds = state.l + config.f * setpoint;
  const Scalar u = between(holds + config.K * (setpoint - w + config.g * (holds - state.t)), low, high);
  state.t = config.c * state.t + (Scalar(1) - config.c) * u;
  state.w = config.a * w + config.b * (state.t - state.l);
  return u;
}

}  // namespace sixstep::control
