// SPDX-License-Identifier: Apache-2.0
// Computes the position loop's setpoint by a profile, and feeds the profile's speed and acceleration forward
// to the inner loops:
//
//   w_ref = K_p (x_ref - x) + v_ref            without v_ref the loop lags by v/K_p
//   y = y_speed + J' a_ref + B' v_ref + c' sgn v_ref
//
// x is the position; x_ref, v_ref and a_ref are position, speed and acceleration of the profile; K_p is the
// position gain. y is the speed controller's output: a fraction of the full torque, or a duty. J', B' and c'
// are the shaft's inertia, friction and Coulomb torque, each divided by the full torque. If y is a duty, they
// are multiplied by R/(K_t U) instead, and K_t/U is added to B' for the back-EMF (Ellis, Control System
// Design Guide, 2012, 8). The speed controller compensates unknown torques, such as a load. Only PI laws use
// the feed-forward: the observers of other laws would estimate it as a load.
#pragma once
#include "sixstep/control/bridge_command.hpp"
#include "sixstep/control/jerk_profile.hpp"
#include "sixstep/control/pi.hpp"

namespace sixstep::control {

/// Default: no feed-forward.
template <class Scalar>
struct MotionFeedForwardConfig {
  bool on = false;
  Scalar per_rad_s2{}, per_rad_s{};
  Scalar coulomb{};
  bool operator==(const MotionFeedForwardConfig&) const = default;
};

template <class Scalar>
constexpr Scalar torque_ahead(const MotionFeedForwardConfig<Scalar>& config,
                              const ProfiledMotion<Scalar>& motion) {
  const Scalar v = motion.speed_rad_s;
  const Scalar coulomb = v > Scalar{} ? config.coulomb : v < Scalar{} ? -config.coulomb : Scalar{};
  return config.per_rad_s2 * motion.acceleration_rad_s2 + config.per_rad_s * v + coulomb;
}

/// A drive contains the profile if SIXSTEP_POSITION_PROFILE is defined before the first header. The build of
/// sixstep defines this macro. An exported header defines it if the exported drive has a profile. A drive
/// without the profile needs 2 KB less flash and, in `float`, 352 bytes less RAM. All translation units of
/// one program must agree on the definition.
#ifdef SIXSTEP_POSITION_PROFILE
inline constexpr bool position_profile_is_there = true;
#else
inline constexpr bool position_profile_is_there = false;
#endif

/// Parts of the position loop that exist in floating point only. The struct is empty in fixed point.
template <class Scalar, bool there = position_profile_is_there>
struct ProfiledPositionConfig {
  bool on = false;
  JerkProfileConfig<Scalar> profile{};
  MotionFeedForwardConfig<Scalar> feed_forward{};
  bool operator==(const ProfiledPositionConfig&) const = default;
};
template <class Storage, int FractionBits>
struct ProfiledPositionConfig<Fixed<Storage, FractionBits>, true> {
  bool operator==(const ProfiledPositionConfig&) const = default;
};
template <class Scalar>
struct ProfiledPositionConfig<Scalar, false> {
  bool operator==(const ProfiledPositionConfig&) const = default;
};
template <class Scalar, bool there = position_profile_is_there>
struct ProfiledPositionState {
  JerkProfileState<Scalar> profile{};
  bool runs = false;  ///< true: the profile computed the setpoint of this tick
};
template <class Storage, int FractionBits>
struct ProfiledPositionState<Fixed<Storage, FractionBits>, true> {};
template <class Scalar>
struct ProfiledPositionState<Scalar, false> {};

/// Position reference of the last tick, for telemetry.
template <class Scalar, bool there = position_profile_is_there>
struct ProfiledReference {
  bool profiled = false;  ///< false: the setpoint is the reference
  Scalar reference_deg{};
};
template <class Storage, int FractionBits>
struct ProfiledReference<Fixed<Storage, FractionBits>, true> {};
template <class Scalar>
struct ProfiledReference<Scalar, false> {};

namespace detail {

/// The setpoint of this tick, degrees. `shaped`: the mode of the previous tick. After another mode the
/// profile starts at the shaft's position and speed.
template <class Scalar>
constexpr Scalar profiled_setpoint(const ProfiledPositionConfig<Scalar>& config,
                                   ProfiledPositionState<Scalar>& state, Mode shaped, Scalar setpoint,
                                   Scalar position_deg, Scalar speed_rad_s) {
  if (shaped != Mode::position) begin_profile(config.profile, state.profile, position_deg, speed_rad_s);
  state.runs = true;
  return jerk_profile_step(config.profile, state.profile, setpoint).position_deg;
}

/// Output of the PI plus `ahead`, limited to low..high. A limited sum is exactly the limit, without a
/// rounding error.
template <class Scalar>
constexpr Scalar pi_beside(const PiConfig<Scalar>& config, PiState<Scalar>& state, Scalar error, Scalar ahead,
                           Scalar low, Scalar high) {
  const Scalar known = between(ahead, low, high);
  const Scalar u = pi_step(config, state, error, low - known, high - known);
  return u == high - known ? high : u == low - known ? low : u + known;
}

}  // namespace detail
}  // namespace sixstep::control
