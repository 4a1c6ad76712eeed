// SPDX-License-Identifier: Apache-2.0
// What a product adds inside the drive's loops: a slewed setpoint, a window for the current reference,
// back-EMF feed-forward, the measured bus, chopping that is smooth through zero, a speed loop in positional
// form with a derivative, a current loop that predicts, the current of the phase that does not commutate. All of it
// stands behind one flag, so that a drive without extras pays one branch per tick.
#pragma once
#include "sixstep/control/bridge_command.hpp"
#include "sixstep/control/commutation.hpp"
#include "sixstep/control/deadbeat.hpp"
#include "sixstep/control/derivative.hpp"
#include "sixstep/control/feed_forward.hpp"
#include "sixstep/control/limits.hpp"
#include "sixstep/control/pi.hpp"
#include "sixstep/control/pi_positional.hpp"
#include "sixstep/control/slew.hpp"
#include "sixstep/control/smooth_chopping.hpp"

namespace sixstep::control {

template <class Scalar>
struct DriveExtras {
  bool on = false;  ///< false: none of the below
  bool slews_setpoint = false;
  SlewConfig<Scalar> slew{};  ///< in the unit of the mode, per tick
  bool limits_current = false;
  LimitsConfig<Scalar> limits{};
  Gain<Scalar> torque_fraction_per_A{};  ///< 1/current_at_full_torque_A: keeps the speed PI inside the window
  FeedForwardConfig<Scalar> feed_forward{};
  BusCompensationConfig<Scalar> bus{};
  bool smooth_chopping = false;  ///< else DriveConfig::chopping
  SmoothChoppingConfig<Scalar> chopping{};
  bool predicts_current = false;  ///< the current loop by the next one, else by DriveConfig::current
  DeadbeatConfig<Scalar> deadbeat{};
  bool staying_phase =
      false;  ///< i_m is the current of the phase that the last commutation left where it was
  bool positional_speed = false;  ///< the speed loop by the next two, else by DriveConfig::speed
  PiPositionalConfig<Scalar> speed{};
  DerivativeConfig<Scalar> speed_derivative{};  ///< of the measured speed, taken off the output
  bool operator==(const DriveExtras&) const = default;
};

template <class Scalar>
struct DriveExtrasState {
  SlewState<Scalar> slew{};
  SmoothChoppingState<Scalar> chopping{};
  DeadbeatState<Scalar> deadbeat{};
  StayingPhase staying{};
  PiPositionalState<Scalar> speed{};
  DerivativeState<Scalar> speed_derivative{};
  Mode slewing = Mode::off;  ///< the mode whose setpoint slews: a new one starts at what is measured
};

namespace detail {

template <class Scalar>
constexpr Scalar slewed_setpoint(const DriveExtras<Scalar>& extras, DriveExtrasState<Scalar>& state,
                                 Mode mode, Scalar setpoint, Scalar measured) {
  if (!extras.slews_setpoint) return setpoint;
  if (state.slewing != mode) state.slew.y = ScalarTraits<Scalar>::accumulator(measured);
  state.slewing = mode;
  return slew_step(extras.slew, state.slew, setpoint);
}

template <class Scalar>
constexpr CurrentWindow<Scalar> allowed_current(const DriveExtras<Scalar>& extras,
                                                const Measurement<Scalar>& m, Scalar limit) {
  const CurrentWindow<Scalar> w = current_window(extras.limits, m.speed_rad_s, m.bus_V);
  return {between(w.low, -limit, limit), between(w.high, -limit, limit)};
}

/// The speed PI, in a cascade within the window: it cannot wind up against a limit that it does not see.
template <class Scalar>
constexpr Scalar speed_with_extras(const DriveExtras<Scalar>& extras, DriveExtrasState<Scalar>& state,
                                   const PiConfig<Scalar>& config, PiState<Scalar>& pi, Scalar error,
                                   Scalar speed_rad_s, const CurrentWindow<Scalar>* window) {
  using T = ScalarTraits<Scalar>;
  const Scalar limit = extras.positional_speed ? extras.speed.limit : config.limit;
  Scalar low = -limit, high = limit;
  if (window != nullptr) {
    low = between(T::product(window->low, extras.torque_fraction_per_A), -limit, limit);
    high = between(T::product(window->high, extras.torque_fraction_per_A), -limit, limit);
  }
  if (!extras.positional_speed) return pi_step(config, pi, error, low, high);
  const Accumulator<Scalar> braked =
      derivative_step(extras.speed_derivative, state.speed_derivative, speed_rad_s);
  return pi_positional_step(extras.speed, state.speed, error, -braked, low, high);
}

/// u = u_PI + e, both together within the limit of the PI. At an end of it u is that end itself: (limit - e)
/// + e may round to one digit less, and a duty just below 1 chops.
template <class Scalar>
constexpr Scalar voltage_with_feed_forward(const DriveExtras<Scalar>& extras, const PiConfig<Scalar>& config,
                                           PiState<Scalar>& state, Scalar error, Scalar speed_rad_s) {
  const Scalar e = clamped(back_emf_voltage(extras.feed_forward, speed_rad_s), config.limit);
  const Scalar low = -config.limit - e, high = config.limit - e;
  const Scalar u = pi_step(config, state, error, low, high);
  return u == high ? config.limit : u == low ? -config.limit : u + e;
}

}  // namespace detail
}  // namespace sixstep::control
