// SPDX-License-Identifier: Apache-2.0
// Adds optional parts to the drive's loops. One flag enables all of them, so that a drive without optional
// parts needs one branch per tick:
// - a slewed setpoint, or a position setpoint by a profile
// - a window for the current reference
// - back-EMF feed-forward, and compensation of the measured bus voltage
// - chopping without a jump at zero duty, and PWM patterns
// - other laws of the speed loop than the PI in velocity form
// - a deadbeat current loop
// - control of the staying phase's current, and a duty that keeps it constant during a commutation
#pragma once
#include "sixstep/control/bridge_command.hpp"
#include "sixstep/control/commutation.hpp"
#include "sixstep/control/commutation_step.hpp"
#include "sixstep/control/deadbeat.hpp"
#include "sixstep/control/derivative.hpp"
#include "sixstep/control/feed_forward.hpp"
#include "sixstep/control/limits.hpp"
#include "sixstep/control/observed_speed.hpp"
#include "sixstep/control/pi.hpp"
#include "sixstep/control/pi_positional.hpp"
#include "sixstep/control/profiled_position.hpp"
#include "sixstep/control/pwm_pattern.hpp"
#include "sixstep/control/slew.hpp"
#include "sixstep/control/sliding_speed.hpp"
#include "sixstep/control/smooth_chopping.hpp"

namespace sixstep::control {

/// Law of the speed loop:
///   pi          pi.hpp
///   positional  pi_positional.hpp with derivative.hpp and a weight of the setpoint
///   observed    observed_speed.hpp
///   sliding     sliding_speed.hpp
enum class SpeedLaw : std::uint8_t { pi, positional, observed, sliding };

/// Laws that exist in floating point only. The struct is empty in fixed point.
template <class Scalar>
struct SpeedLaws {
  ObservedSpeedConfig<Scalar> observed{};
  SlidingSpeedConfig<Scalar> sliding{};
  bool operator==(const SpeedLaws&) const = default;
};
template <class Storage, int FractionBits>
struct SpeedLaws<Fixed<Storage, FractionBits>> {
  bool operator==(const SpeedLaws&) const = default;
};
template <class Scalar>
struct SpeedLawsState {
  ObservedSpeedState<Scalar> observed{};
  SlidingSpeedState<Scalar> sliding{};
};
template <class Storage, int FractionBits>
struct SpeedLawsState<Fixed<Storage, FractionBits>> {};

template <class Scalar>
struct DriveExtras {
  bool on = false;  ///< false: no member below is used
  bool slews_setpoint = false;
  SlewConfig<Scalar> slew{};  ///< largest step per tick, in the unit of the mode
  bool limits_current = false;
  LimitsConfig<Scalar> limits{};
  Gain<Scalar> torque_fraction_per_A{};  ///< 1/current_at_full_torque_A: converts the window of currents to
                                         ///< limits of the speed PI
  FeedForwardConfig<Scalar> feed_forward{};
  BusCompensationConfig<Scalar> bus{};
  bool smooth_chopping = false;  ///< false: DriveConfig::chopping applies
  SmoothChoppingConfig<Scalar> chopping{};
  PwmPatternConfig<Scalar> pwm{};  ///< which switch of the pair is chopped
  bool predicts_current = false;   ///< true: `deadbeat` is the current loop, false: DriveConfig::current
  DeadbeatConfig<Scalar> deadbeat{};
  bool staying_phase = false;      ///< true: i_m is the current of the staying phase (commutation.hpp)
  bool steps_commutation = false;  ///< true: a duty step keeps the current constant during a commutation, and
                                   ///< the current loop is not executed
  CommutationStepConfig<Scalar> commutation{};
  SpeedLaw speed_law = SpeedLaw::pi;  ///< pi uses DriveConfig::speed; positional uses the next three members
  PiPositionalConfig<Scalar> speed{};
  DerivativeConfig<Scalar> speed_derivative{};  ///< acts on the measured speed; its output is subtracted
  Gain<Scalar> speed_weight_off{};  ///< (1 - b) K, with proportional gain K and setpoint weight b of the
                                    ///< proportional part
  SpeedLaws<Scalar> laws{};         ///< DriveConfig::speed.limit limits their outputs
  [[no_unique_address]] ProfiledPositionConfig<Scalar> position{};  ///< replaces `slew` in Mode::position
  bool operator==(const DriveExtras&) const = default;
};

template <class Scalar>
struct DriveExtrasState {
  SlewState<Scalar> slew{};
  SmoothChoppingState<Scalar> chopping{};
  PwmPatternState<Scalar> pwm{};
  DeadbeatState<Scalar> deadbeat{};
  StayingPhase staying{};
  CommutationStepState<Scalar> commutation{};
  PiPositionalState<Scalar> speed{};
  DerivativeState<Scalar> speed_derivative{};
  SpeedLawsState<Scalar> laws{};
  [[no_unique_address]] ProfiledPositionState<Scalar> position{};
  Mode slewing = Mode::off;  ///< mode whose setpoint is shaped; after a change of mode the setpoint starts at
                             ///< the measurement
};

namespace detail {

template <class Scalar>
constexpr Scalar slewed_setpoint(const DriveExtras<Scalar>& extras, DriveExtrasState<Scalar>& state,
                                 Mode mode, Scalar setpoint, Scalar measured, Scalar speed_rad_s) {
  if constexpr (requires { extras.position.profile; }) {
    if (extras.position.on) {
      const Mode shaped = state.slewing;
      state.slewing = mode;
      state.position.runs = mode == Mode::position;
      if (state.position.runs)
        return profiled_setpoint(extras.position, state.position, shaped, setpoint, measured, speed_rad_s);
      state.slewing = shaped == mode ? mode : Mode::off;
    }
  }
  if (!extras.slews_setpoint) return setpoint;
  if (state.slewing != mode) state.slew.y = ScalarTraits<Scalar>::accumulator(measured);
  state.slewing = mode;
  return slew_step(extras.slew, state.slew, setpoint);
}

template <class Scalar, class Telemetry>
constexpr void tell_profile(const DriveExtras<Scalar>& extras, const DriveExtrasState<Scalar>& state,
                            Scalar reference, Telemetry& telemetry) {
  if constexpr (requires { extras.position.profile; }) {
    telemetry.position = {extras.position.on && state.position.runs, reference};
  }
}

/// True if this tick feeds the profile's speed and torque forward.
template <class Scalar>
constexpr bool tells_ahead(const DriveExtras<Scalar>& extras, const DriveExtrasState<Scalar>& state) {
  if constexpr (requires { extras.position.profile; })
    return extras.on && extras.position.on && extras.position.feed_forward.on && state.position.runs;
  else
    return false;
}

/// Speed reference of the position loop: w, plus the profile's speed if the profile is fed forward.
template <class Scalar>
constexpr Scalar with_speed_ahead(const DriveExtras<Scalar>& extras, const DriveExtrasState<Scalar>& state,
                                  Scalar w) {
  if constexpr (requires { extras.position.profile; })
    if (tells_ahead(extras, state)) return w + state.position.profile.now.speed_rad_s;
  return w;
}

template <class Scalar>
constexpr CurrentWindow<Scalar> allowed_current(const DriveExtras<Scalar>& extras,
                                                const Measurement<Scalar>& m, Scalar limit) {
  const CurrentWindow<Scalar> w = current_window(extras.limits, m.speed_rad_s, m.bus_V);
  return {between(w.low, -limit, limit), between(w.high, -limit, limit)};
}

/// PID with two degrees of freedom (Astrom and Hagglund, PID Controllers, 3.4). Output: K (b r - y) +
/// integral - derivative, with setpoint r and measurement y.
template <class Scalar>
constexpr Scalar positional_speed(const DriveExtras<Scalar>& extras, DriveExtrasState<Scalar>& state,
                                  Scalar error, Scalar speed_rad_s, Scalar ahead, Scalar low, Scalar high) {
  using T = ScalarTraits<Scalar>;
  const Accumulator<Scalar> braked =
      derivative_step(extras.speed_derivative, state.speed_derivative, speed_rad_s);
  const Accumulator<Scalar> weighted = T::accumulated(error + speed_rad_s, extras.speed_weight_off);
  const Accumulator<Scalar> known =
      ahead == Scalar{} ? -braked - weighted : -braked - weighted + T::accumulator(ahead);
  return pi_positional_step(extras.speed, state.speed, error, known, low, high);
}

/// One tick of the speed controller. In a cascade its output stays within the window of current references,
/// because otherwise its integral would wind up at the window's limits.
template <class Scalar>
constexpr Scalar speed_with_extras(const DriveExtras<Scalar>& extras, DriveExtrasState<Scalar>& state,
                                   const PiConfig<Scalar>& config, PiState<Scalar>& pi, Scalar error,
                                   Scalar speed_rad_s, const CurrentWindow<Scalar>* window) {
  using T = ScalarTraits<Scalar>;
  const bool positional = extras.speed_law == SpeedLaw::positional;
  const Scalar limit = positional ? extras.speed.limit : config.limit;
  Scalar low = -limit, high = limit;
  if (window != nullptr) {
    low = between(T::product(window->low, extras.torque_fraction_per_A), -limit, limit);
    high = between(T::product(window->high, extras.torque_fraction_per_A), -limit, limit);
  }
  Scalar ahead{};
  if constexpr (requires { extras.position.profile; })
    if (tells_ahead(extras, state))
      ahead = torque_ahead(extras.position.feed_forward, state.position.profile.now);
  if (positional) return positional_speed(extras, state, error, speed_rad_s, ahead, low, high);
  if constexpr (requires { extras.laws.observed; }) {
    if (extras.speed_law == SpeedLaw::observed)
      return observed_speed_step(extras.laws.observed, state.laws.observed, error, speed_rad_s, low, high);
    if (extras.speed_law == SpeedLaw::sliding)
      return sliding_speed_step(extras.laws.sliding, state.laws.sliding, error, speed_rad_s, low, high);
  }
  return ahead == Scalar{} ? pi_step(config, pi, error, low, high)
                           : pi_beside(config, pi, error, ahead, low, high);
}

/// u = u_PI + e, within the limit of the PI. At the limit u is set to exactly the limit: (limit - e) + e may
/// round to a value one digit below the limit, and a duty just below 1 would chop.
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
