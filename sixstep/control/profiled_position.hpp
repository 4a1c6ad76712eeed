// SPDX-License-Identifier: Apache-2.0
// The position loop's setpoint by a profile, with what the profile knows told ahead to the loops within:
//
//   w_ref = K_p (x_ref - x) + v_ref            else the loop lags by v/K_p behind whatever moves
//   y = y_speed + J' a_ref + B' v_ref + c' sgn v_ref
//
// y is the speed controller's output, a part of the full torque, or a duty. J', B' and c' are the shaft's inertia, friction
// and Coulomb torque over the full torque; for a duty their current over the bus's, R/(K_t U), and K_t/U more in B' for the
// back-EMF (Ellis, Control System Design Guide, 2012, 8). What is not known, a load say, is left to the speed controller, which
// is a PI: the observers of other laws would take the torque ahead for a load, and are not given it.
#pragma once
#include "sixstep/control/bridge_command.hpp"
#include "sixstep/control/jerk_profile.hpp"
#include "sixstep/control/pi.hpp"

namespace sixstep::control {

/// The default adds nothing.
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

/// A drive has room for it where SIXSTEP_POSITION_PROFILE is defined ahead of the first header, as sixstep is built, and as an exported
/// header does whose drive has a profile: 2 KB of flash and 352 bytes of RAM in `float`, which nobody else is to pay. All that is
/// linked into one program has it defined, or nothing.
#ifdef SIXSTEP_POSITION_PROFILE
inline constexpr bool position_profile_is_there = true;
#else
inline constexpr bool position_profile_is_there = false;
#endif

/// What of the position loop is there in floating point only takes no memory in fixed point.
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
  bool runs = false;  ///< in this tick
};
template <class Storage, int FractionBits>
struct ProfiledPositionState<Fixed<Storage, FractionBits>, true> {};
template <class Scalar>
struct ProfiledPositionState<Scalar, false> {};

/// Of the last tick, in telemetry.
template <class Scalar, bool there = position_profile_is_there>
struct ProfiledReference {
  bool profiled = false;  ///< else the setpoint is the reference
  Scalar reference_deg{};
};
template <class Storage, int FractionBits>
struct ProfiledReference<Fixed<Storage, FractionBits>, true> {};
template <class Scalar>
struct ProfiledReference<Scalar, false> {};

namespace detail {

/// The setpoint of this tick. `shaped`: the mode whose setpoint was shaped before; a new one begins where the shaft is, as fast
/// as it turns.
template <class Scalar>
constexpr Scalar profiled_setpoint(const ProfiledPositionConfig<Scalar>& config,
                                   ProfiledPositionState<Scalar>& state, Mode shaped, Scalar setpoint,
                                   Scalar position_deg, Scalar speed_rad_s) {
  if (shaped != Mode::position) begin_profile(config.profile, state.profile, position_deg, speed_rad_s);
  state.runs = true;
  return jerk_profile_step(config.profile, state.profile, setpoint).position_deg;
}

/// u_PI + ahead, both together within the window; at an end of it u is that end itself.
template <class Scalar>
constexpr Scalar pi_beside(const PiConfig<Scalar>& config, PiState<Scalar>& state, Scalar error, Scalar ahead,
                           Scalar low, Scalar high) {
  const Scalar known = between(ahead, low, high);
  const Scalar u = pi_step(config, state, error, low - known, high - known);
  return u == high - known ? high : u == low - known ? low : u + known;
}

}  // namespace detail
}  // namespace sixstep::control
