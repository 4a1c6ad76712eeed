// SPDX-License-Identifier: Apache-2.0
// Replaces the configuration while the drive runs, between two ticks: gains, limits, chopping, mode.
//
//   same mode     All states are kept. A PI in velocity form continues from its last output and its last
//                 error: with the new gains the next tick adds d1 (e[n] - e[n-1]) + K_i e[n-1], which is 0 at
//                 zero error. The positional form keeps its integral; its output changes by the change of K
//                 times the error. An observer and a sliding surface continue from their states.
//   other law     The new law of the speed loop starts with the old law's output at zero error. At zero error
//                 the output does not change. In the positional form this holds only if the setpoint is not
//                 weighted.
//   other mode    A loop that both modes use keeps its state. A loop that only the new mode uses starts with
//                 output 0. A slewed or profiled setpoint starts at the measurement (drive_extras.hpp). The
//                 bridge keeps the last command until the next tick.
//   other limits  A position profile with other limits continues from its position and speed, without
//                 acceleration.
#pragma once
#include "sixstep/control/protected_drive.hpp"

namespace sixstep::control {

namespace detail {

template <class Scalar>
constexpr bool runs_speed_loop(const DriveConfig<Scalar>& config) {
  return config.mode == Mode::speed || config.mode == Mode::position;
}
template <class Scalar>
constexpr bool runs_current_loop(const DriveConfig<Scalar>& config) {
  return config.mode == Mode::current ||
         (runs_speed_loop(config) && config.speed_control == SpeedControl::cascade);
}

/// Resets the loops that the mode of `config` does not use.
template <class Scalar>
constexpr void rest_idle_loops(const DriveConfig<Scalar>& config, DriveState<Scalar>& state) {
  if (!runs_current_loop(config)) {
    state.current = {};
    state.hysteresis = {};
    state.extras.deadbeat = {};
  }
  if (!runs_speed_loop(config)) {
    state.speed = {};
    state.extras.speed = {};
    state.extras.speed_derivative = {};
    state.extras.laws = {};
  }
}

/// Output of the speed loop at zero error.
template <class Scalar>
constexpr Scalar held_by_speed_law(const DriveConfig<Scalar>& config, const DriveState<Scalar>& state) {
  using T = ScalarTraits<Scalar>;
  const SpeedLaw law = config.extras.on ? config.extras.speed_law : SpeedLaw::pi;
  if (law == SpeedLaw::positional)
    return between(T::signal(state.extras.speed.integral), -config.extras.speed.limit,
                   config.extras.speed.limit);
  if constexpr (requires { state.extras.laws.observed; }) {
    if (law == SpeedLaw::observed) return state.extras.laws.observed.t;
    if (law == SpeedLaw::sliding) return state.extras.laws.sliding.held;
  }
  return T::signal(T::accumulator(Scalar{}) + state.speed.u);
}

/// Starts a new law of the speed loop with the output of the old law at zero error.
template <class Scalar>
constexpr void hand_speed_over(const DriveConfig<Scalar>& config, DriveState<Scalar>& state,
                               const DriveConfig<Scalar>& next) {
  const SpeedLaw before = config.extras.on ? config.extras.speed_law : SpeedLaw::pi,
                 law = next.extras.on ? next.extras.speed_law : SpeedLaw::pi;
  if (law == before) return;
  const Scalar held = held_by_speed_law(config, state);
  state.speed = {};
  state.extras.speed = {};
  state.extras.speed_derivative = {};
  state.extras.laws = {};
  if (law == SpeedLaw::pi) state.speed.u = ScalarTraits<Scalar>::accumulator(held);
  if (law == SpeedLaw::positional) state.extras.speed.integral = ScalarTraits<Scalar>::accumulator(held);
  if constexpr (requires { state.extras.laws.observed; }) {
    if (law == SpeedLaw::observed) state.extras.laws.observed.l = held;
    if (law == SpeedLaw::sliding) state.extras.laws.sliding.m = held;
  }
}

/// Restarts the position profile at its present position and speed, because its counts depend on the limits.
template <class Scalar>
constexpr void hand_profile_over(const DriveConfig<Scalar>& config, DriveState<Scalar>& state,
                                 const DriveConfig<Scalar>& next) {
  if constexpr (requires { next.extras.position.profile; }) {
    if (!next.extras.on || !next.extras.position.on) return;
    const JerkProfileConfig<Scalar>& profile = next.extras.position.profile;
    if (!config.extras.on || !config.extras.position.on) {
      state.extras.slewing = Mode::off;
    } else if (!(profile == config.extras.position.profile)) {
      const ProfiledMotion<Scalar> now = state.extras.position.profile.now;
      begin_profile(profile, state.extras.position.profile, now.position_deg, now.speed_rad_s);
    }
  }
}

}  // namespace detail

template <class Scalar>
constexpr void retune(DriveConfig<Scalar>& config, DriveState<Scalar>& state,
                      const DriveConfig<Scalar>& next) {
  if (next.mode != config.mode) detail::rest_idle_loops(config, state);
  detail::hand_speed_over(config, state, next);
  detail::hand_profile_over(config, state, next);
  config = next;
}

/// Replaces thresholds, limits and the inner drive. Loops that braking or alignment uses keep their states.
template <class Scalar>
constexpr void retune(ProtectedConfig<Scalar>& config, ProtectedState<Scalar>& state,
                      const ProtectedConfig<Scalar>& next) {
  if (next.drive.mode != config.drive.mode && state.activity.activity == Activity::run)
    detail::rest_idle_loops(config.drive, state.drive);
  detail::hand_speed_over(config.drive, state.drive, next.drive);
  detail::hand_profile_over(config.drive, state.drive, next.drive);
  config = next;
}

}  // namespace sixstep::control
