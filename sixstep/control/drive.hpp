// SPDX-License-Identifier: Apache-2.0
// The composition that firmware calls: position P -> speed PI -> current loop -> six-step, as deep as the
// mode asks, or speed PI -> duty (thesis 6.2.2). Two entries: step() once per control tick, on_hall() in the
// Hall interrupt.
#pragma once
#include "sixstep/control/bridge_command.hpp"
#include "sixstep/control/commutation.hpp"
#include "sixstep/control/drive_extras.hpp"
#include "sixstep/control/hysteresis.hpp"
#include "sixstep/control/pi.hpp"

namespace sixstep::control {

enum class CurrentControl : std::uint8_t { pi, hysteresis };

/// What a speed loop sets: the current reference of a loop within, or the duty itself.
enum class SpeedControl : std::uint8_t { cascade, duty };

/// Every default leaves the bridge off.
template <class Scalar>
struct DriveConfig {
  Mode mode = Mode::off;
  Chopping chopping = Chopping::soft;
  CurrentControl current_control = CurrentControl::pi;
  PiConfig<Scalar> current{};  ///< A -> V
  HysteresisConfig<Scalar> hysteresis{};
  Divisor<Scalar> nominal_bus_V{};  ///< d = u / nominal_bus_V
  PiConfig<Scalar> speed{};         ///< rad/s -> fraction of the torque limit; SpeedControl::duty: -> duty
  Gain<Scalar> current_at_full_torque_A{};  ///< torque limit / K_t: i_ref = y * this
  Scalar current_limit_A{};      ///< of the reference a speed loop gives; give speed.limit the same
  Gain<Scalar> position_gain{};  ///< degrees -> rad/s
  Scalar speed_limit_rad_s{};    ///< of the reference a position loop gives
  SpeedControl speed_control = SpeedControl::cascade;
  DriveExtras<Scalar> extras{};
  bool operator==(const DriveConfig&) const = default;
};

template <class Scalar>
struct DriveState {
  PiState<Scalar> current{}, speed{};
  HysteresisState<Scalar> hysteresis{};
  bool reversed = false;            ///< sign of the last command
  BridgeCommand<Scalar> command{};  ///< the last answer; on_hall moves it to the new pair
  DriveExtrasState<Scalar> extras{};
};

/// What the loops had in hand; nobody reads it back.
template <class Scalar>
struct Telemetry {
  Scalar motor_current_A{};
  Scalar current_reference_A{};
  Scalar speed_reference_rad_s{};
  Scalar duty{};  ///< signed
  [[no_unique_address]] ProfiledReference<Scalar> position{};
};

namespace detail {

template <class Scalar>
constexpr BridgeCommand<Scalar> bridge_off(bool fault) {
  BridgeCommand<Scalar> command{};
  command.fault = fault;
  return command;
}

/// d < 0 swaps source and sink; d = 0 counts as positive (model.md 3).
template <class Scalar>
constexpr void set_duty(DriveState<Scalar>& state, Pair positive, Scalar d) {
  state.reversed = d < Scalar{};
  state.command.pair = state.reversed ? swapped(positive) : positive;
  state.command.duty = state.reversed ? -d : d;
  state.command.watch = Watch::none;
}

template <class Scalar>
constexpr void arm_hysteresis(const DriveConfig<Scalar>& config, DriveState<Scalar>& state, Pair positive,
                              Scalar motor_current, Scalar reference) {
  const bool reversed = reference < Scalar{};
  const Scalar level = reversed ? -reference : reference;
  state.reversed = reversed;
  state.command.pair = reversed ? swapped(positive) : positive;
  state.command.watch = config.hysteresis.watch;
  state.command.on_below_A = level - config.hysteresis.band_A;
  state.command.off_above_A = level + config.hysteresis.band_A;
  if (config.hysteresis.watch == Watch::none) {
    const Scalar current = reversed ? -motor_current : motor_current;
    state.command.duty =
        hysteresis_step(config.hysteresis, state.hysteresis, current, level) ? one<Scalar> : Scalar{};
  }
}

/// The setpoint of a speed loop: the position loop's answer, or what was asked.
template <class Scalar>
constexpr Scalar speed_reference(const DriveConfig<Scalar>& config, const DriveState<Scalar>& state,
                                 Mode mode, Scalar setpoint, const Measurement<Scalar>& measured) {
  if (mode != Mode::position) return setpoint;
  const Scalar w = ScalarTraits<Scalar>::product(setpoint - measured.position_deg, config.position_gain);
  return clamped(with_speed_ahead(config.extras, state.extras, w), config.speed_limit_rad_s);
}

/// The speed controller's output: a fraction of the torque limit, or the duty.
template <class Scalar>
constexpr Scalar speed_output(const DriveConfig<Scalar>& config, DriveState<Scalar>& state, Scalar error,
                              const Measurement<Scalar>& measured) {
  const DriveExtras<Scalar>& extras = config.extras;
  if (!extras.on) return pi_step(config.speed, state.speed, error);
  CurrentWindow<Scalar> window{};
  const bool bounded = extras.limits_current && config.speed_control == SpeedControl::cascade;
  if (bounded) window = allowed_current(extras, measured, config.current_limit_A);
  return speed_with_extras(extras, state.extras, config.speed, state.speed, error, measured.speed_rad_s,
                           bounded ? &window : nullptr);
}

/// u/U_s; without a nominal bus voltage there is no duty.
template <class Scalar>
constexpr Scalar duty_for(const DriveConfig<Scalar>& config, Scalar u, const Measurement<Scalar>& measured) {
  const DriveExtras<Scalar>& extras = config.extras;
  if (extras.on && extras.bus.lowest_bus_V > Scalar{}) return compensated_duty(extras.bus, u, measured.bus_V);
  if (!(config.nominal_bus_V > Divisor<Scalar>{})) return Scalar{};
  return clamped(ScalarTraits<Scalar>::quotient(u, config.nominal_bus_V), one<Scalar>);
}

template <class Scalar>
constexpr Scalar current_to_duty(const DriveConfig<Scalar>& config, DriveState<Scalar>& state,
                                 Scalar reference, Scalar i_m, const Measurement<Scalar>& measured) {
  const DriveExtras<Scalar>& extras = config.extras;
  const Scalar u =
      !extras.on ? pi_step(config.current, state.current, reference - i_m)
      : extras.predicts_current
          ? deadbeat_step(extras.deadbeat, state.extras.deadbeat, reference, i_m, measured.speed_rad_s)
          : voltage_with_feed_forward(extras, config.current, state.current, reference - i_m,
                                      measured.speed_rad_s);
  return duty_for(config, u, measured);
}

/// The part of the bus that a voltage of the staying phase is (commutation_step.hpp).
template <class Scalar>
constexpr Scalar holding_part(const DriveConfig<Scalar>& config, Scalar u,
                              const Measurement<Scalar>& measured) {
  const bool overlaps = Scalar{} < config.extras.commutation.overlap_bus_V;
  return between(duty_for(config, u, measured), Scalar{}, overlaps ? one<Scalar> : half_of_one<Scalar>());
}

/// What the duty steps to, known before the commutation: it goes by the last tick's speed and current. Without a current
/// loop nothing is held.
template <class Scalar>
constexpr void look_at_commutation(Mode mode, const DriveConfig<Scalar>& config, DriveState<Scalar>& state,
                                   const Measurement<Scalar>& measured, std::uint8_t sector) {
  CommutationStepState<Scalar>& s = state.extras.commutation;
  if (mode == Mode::duty || (mode != Mode::current && config.speed_control == SpeedControl::duty)) {
    s = {};
    return;
  }
  watch_leaving(config.extras.commutation, s, measured, sector, state.reversed);
  s.part = holding_part(config, s.volts, measured);
}

/// While the others hand over, the staying phase is held, and its loop with it.
template <class Scalar>
constexpr bool holds_current(const DriveConfig<Scalar>& config, const DriveState<Scalar>& state) {
  return config.extras.on && config.extras.steps_commutation && state.extras.commutation.hands_over;
}

/// The pair goes on, and the staying phase towards its reference.
template <class Scalar>
constexpr void hold_towards(const DriveConfig<Scalar>& config, DriveState<Scalar>& state,
                            const Measurement<Scalar>& measured, Pair positive, Scalar i_ref) {
  state.command.pair = state.reversed ? swapped(positive) : positive;
  CommutationStepState<Scalar>& s = state.extras.commutation;
  const Scalar u = corrected_voltage(config.extras.commutation, s, state.reversed ? -i_ref : i_ref);
  s.part = between(holding_part(config, u, measured), Scalar{}, greatest_part(s.part));
}

/// The command of a pair that is known, with what holds the staying phase meanwhile.
template <class Scalar>
constexpr void hold_current(const DriveConfig<Scalar>& config, DriveState<Scalar>& state) {
  const CommutationStepState<Scalar>& held = state.extras.commutation;
  state.command.overlap = Scalar{};
  if (!holds_current(config, state) || !state.command.enabled) return;
  state.command.duty = holding_duty(held, state.command.pair, state.command.chopped);
  state.command.overlap = holding_overlap(held, state.command.pair);
}

/// What a slewed setpoint starts from: the measurement in the unit of the mode.
template <class Scalar>
constexpr Scalar measured_value(Mode mode, const Measurement<Scalar>& measured, Scalar motor_current) {
  return mode == Mode::current    ? motor_current
         : mode == Mode::speed    ? measured.speed_rad_s
         : mode == Mode::position ? measured.position_deg
                                  : Scalar{};
}

/// All gates off until the next tick; the loops keep what they have in hand.
template <class Scalar>
constexpr void coast(DriveState<Scalar>& state) {
  state.command.enabled = false;
  state.command.duty = Scalar{};
  state.command.watch = Watch::none;
}

/// The loops of one tick, as deep as the mode asks: sets pair and duty, or arms the comparators.
template <class Scalar>
constexpr void run_loops(Mode mode, const DriveConfig<Scalar>& config, DriveState<Scalar>& state,
                         const Measurement<Scalar>& measured, Pair positive, Scalar value, Scalar i_m,
                         Telemetry<Scalar>& telemetry) {
  if (mode == Mode::duty) return set_duty(state, positive, clamped(value, one<Scalar>));
  const bool limits = config.extras.on && config.extras.limits_current;
  Scalar i_ref = value;
  if (mode != Mode::current) {
    const Scalar w_ref = speed_reference(config, state, mode, value, measured);
    const Scalar error = w_ref - measured.speed_rad_s;
    telemetry.speed_reference_rad_s = w_ref;
    if (config.speed_control == SpeedControl::duty)
      return set_duty(state, positive, clamped(speed_output(config, state, error, measured), one<Scalar>));
    i_ref = clamped(ScalarTraits<Scalar>::product(speed_output(config, state, error, measured),
                                                  config.current_at_full_torque_A),
                    config.current_limit_A);
  } else if (limits) {
    const CurrentWindow<Scalar> window =
        current_window(config.extras.limits, measured.speed_rad_s, measured.bus_V);
    i_ref = between(i_ref, window.low, window.high);
  }
  telemetry.current_reference_A = i_ref;
  // The current loop has nothing that it could act on, and would only gather what the sensor is off by.
  if (limits && must_coast(config.extras.limits, i_ref, measured.speed_rad_s, measured.bus_V))
    return coast(state);
  if (config.current_control == CurrentControl::hysteresis)
    arm_hysteresis(config, state, positive, i_m, i_ref);
  else if (holds_current(config, state))
    hold_towards(config, state, measured, positive, i_ref);
  else
    set_duty(state, positive, current_to_duty(config, state, i_ref, i_m, measured));
  if (limits && over_limit(config.extras.limits, measured)) coast(state);
}

}  // namespace detail

/// One control tick in a mode that may differ from the configured one (braking, say). A cascade runs outer to
/// inner from one sample (model.md 4). An impossible Hall code turns the bridge off and reports a fault. The answer
/// lies in `state`, up to the next call: on a chip a copy would cost as much as the current loop.
template <class Scalar>
constexpr const BridgeCommand<Scalar>& step_in(Mode mode, const DriveConfig<Scalar>& config,
                                               DriveState<Scalar>& state, const Measurement<Scalar>& measured,
                                               const Setpoint<Scalar>& setpoint,
                                               Telemetry<Scalar>& telemetry) {
  const std::uint8_t sector = sector_of_hall(measured.hall);
  if (mode == Mode::off || sector == no_sector) {
    state.command = detail::bridge_off<Scalar>(sector == no_sector);
    state.extras.slewing = Mode::off;
    return state.command;
  }
  const Pair positive = positive_pair(sector);
  const Scalar i_m = config.extras.on && config.extras.staying_phase
                         ? staying_current(state.extras.staying, measured, sector)
                         : motor_current(measured, positive);
  state.command.enabled = true;
  state.command.fault = false;
  state.command.chopping = config.chopping;
  telemetry.motor_current_A = i_m;
  Scalar value = setpoint.value;
  if (config.extras.on) {
    value = detail::slewed_setpoint(config.extras, state.extras, mode, value,
                                    detail::measured_value(mode, measured, i_m), measured.speed_rad_s);
    detail::tell_profile(config.extras, state.extras, value, telemetry);
  }
  if (config.extras.on && config.extras.steps_commutation)
    detail::look_at_commutation(mode, config, state, measured, sector);
  detail::run_loops(mode, config, state, measured, positive, value, i_m, telemetry);
  if (config.extras.on && config.extras.smooth_chopping)
    state.command.chopping =
        smooth_chopping_step(config.extras.chopping, state.extras.chopping, state.reversed, i_m);
  if (config.extras.on && config.extras.pwm.pattern != PwmPattern::upper) {
    move_in_sector(config.extras.pwm, state.extras.pwm, sector, measured.speed_rad_s);
    state.command.chopped = chopped_switch(config.extras.pwm, state.extras.pwm, sector, state.command.pair);
  }
  if (config.extras.on && config.extras.steps_commutation) detail::hold_current(config, state);
  telemetry.duty = state.reversed ? -state.command.duty : state.command.duty;
  return state.command;
}

/// One control tick: once per PWM period.
template <class Scalar>
constexpr const BridgeCommand<Scalar>& step(const DriveConfig<Scalar>& config, DriveState<Scalar>& state,
                                            const Measurement<Scalar>& measured,
                                            const Setpoint<Scalar>& setpoint, Telemetry<Scalar>& telemetry) {
  return step_in(config.mode, config, state, measured, setpoint, telemetry);
}

/// The Hall interrupt: the present state moves to the new pair at once; duty and sign stay (model.md 3), which of its
/// switches is chopped goes by the pattern, and where the commutation is stepped the duty goes to what it holds.
template <class Scalar>
constexpr const BridgeCommand<Scalar>& on_hall(const DriveConfig<Scalar>& config, DriveState<Scalar>& state,
                                               std::uint8_t code) {
  const std::uint8_t sector = sector_of_hall(code);
  if (config.mode == Mode::off || sector == no_sector) {
    state.command = detail::bridge_off<Scalar>(sector == no_sector);
    return state.command;
  }
  const Pair positive = positive_pair(sector);
  state.command.pair = state.reversed ? swapped(positive) : positive;
  if (config.extras.on && config.extras.pwm.pattern != PwmPattern::upper)
    state.command.chopped = chopped_switch(config.extras.pwm, state.extras.pwm, sector, state.command.pair);
  if (config.extras.on && config.extras.steps_commutation) {
    enter_sector(config.extras.commutation, state.extras.commutation, sector);
    detail::hold_current(config, state);
  }
  return state.command;
}

}  // namespace sixstep::control
