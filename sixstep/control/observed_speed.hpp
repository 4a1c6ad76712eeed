// SPDX-License-Identifier: Apache-2.0
// Controls the speed with an observer that estimates speed and load; the controller feeds back these two
// estimates. The observer's model uses torques as fractions of the torque limit. The torque t follows the
// output u with a lag. An unmeasured constant load l acts against t. w is the speed; a, b, c are constants of
// ObservedSpeedConfig:
//
//   t[n] = c t[n-1] + (1 - c) u[n],   w[n+1] = a w[n] + b (t[n] - l)
//
// The measured speed y corrects the observer's prediction by the error e, in current form (Franklin, Powell
// and Workman, Digital Control of Dynamic Systems, 8.2.2). The output u is the torque u_r for a constant
// speed r, the setpoint, plus a part proportional to the speed difference:
//   e = y - w[n|n-1],   w[n|n] = w[n|n-1] + L_w e,   l[n] = l[n-1] - L_l e
//   u_r = l + f r,      u = u_r + K (r - w[n|n] + g (u_r - t[n-1]))
//
// g is the speed that the delayed torque will still add per unit of torque: w + g t behaves as if there were
// no lag (design/loops/speed_laws.hpp). The estimated load replaces an integral: at rest y = r for any load.
// The observer uses the limited u, so that its estimates do not wind up.
//
// With c = f = g = 0 and a = 1 the law is linear active disturbance rejection (Gao, Scaling and
// bandwidth-parameterization based controller tuning, ACC 2003; current form: Miklosovic, Radke and Gao, ACC
// 2006), with b_0 = b/T and z_2 = -b_0 l. In this case l also contains friction and all other effects that
// the model neglects.
//
// This law exists in floating point only: its scaling in fixed point is not proved.
#pragma once
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

/// Default: the output is 0.
template <class Scalar>
struct ObservedSpeedConfig {
  Scalar a{};    ///< fraction of the speed that remains after one control period
  Scalar b{};    ///< rad/s that full torque adds in one control period
  Scalar c{};    ///< fraction of the old torque that remains after one control period
  Scalar L_w{};  ///< correction of the speed per rad/s of error
  Scalar L_l{};  ///< correction of the load per rad/s of error
  Scalar K{};    ///< output per rad/s
  Scalar f{};    ///< output per rad/s that compensates friction
  Scalar g{};    ///< rad/s that the delayed torque will still add, per output
  bool operator==(const ObservedSpeedConfig&) const = default;
};

template <class Scalar>
struct ObservedSpeedState {
  Scalar w{};            ///< speed predicted for the next sample, rad/s
  Scalar l{};            ///< load as a fraction of the torque limit; before the first sample: the initial
                         ///< output
  Scalar t{};            ///< torque as a fraction of the torque limit
  bool started = false;  ///< false: the next sample initialises the observer
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
