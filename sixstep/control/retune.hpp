// SPDX-License-Identifier: Apache-2.0
// Another configuration while the drive runs, taken over between two ticks: gains, limits, chopping, mode.
//
//   same mode   every state stays. A PI in velocity form goes on from its last output and its last error: with
//               the new gains the next tick adds d1 (e[n] - e[n-1]) + K_i e[n-1], so that at no error nothing
//               moves. The positional form keeps its integral; its output moves by the change of K times the
//               error.
//   other mode  a loop that both modes run keeps its state; one that only the new mode runs begins at rest,
//               its output 0. A setpoint that slews starts at what is measured (drive_extras.hpp). The bridge
//               keeps the last command until the next tick.
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

/// What the old mode did not run begins at rest.
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
  }
}

}  // namespace detail

template <class Scalar>
constexpr void retune(DriveConfig<Scalar>& config, DriveState<Scalar>& state,
                      const DriveConfig<Scalar>& next) {
  if (next.mode != config.mode) detail::rest_idle_loops(config, state);
  config = next;
}

/// Thresholds, limits and the drive within. Braking and alignment run loops of their own; they keep theirs.
template <class Scalar>
constexpr void retune(ProtectedConfig<Scalar>& config, ProtectedState<Scalar>& state,
                      const ProtectedConfig<Scalar>& next) {
  if (next.drive.mode != config.drive.mode && state.activity.activity == Activity::run)
    detail::rest_idle_loops(config.drive, state.drive);
  config = next;
}

}  // namespace sixstep::control
