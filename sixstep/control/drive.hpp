// SPDX-License-Identifier: Apache-2.0
// Computes the bridge command of a six-step drive: position P -> speed PI -> current loop -> commutation. The
// mode selects the loop at which the chain begins. Alternatively the speed PI sets the duty directly.
// Firmware calls step() once per control tick and on_hall() in the Hall interrupt.
#pragma once
#include "sixstep/control/bridge_command.hpp"
#include "sixstep/control/commutation.hpp"
#include "sixstep/control/drive_extras.hpp"
#include "sixstep/control/hysteresis.hpp"
#include "sixstep/control/pi.hpp"

namespace sixstep::control {

enum class CurrentControl : std::uint8_t { pi, hysteresis };

/// Output of the speed loop: the reference of an inner current loop, or the duty directly.
enum class SpeedControl : std::uint8_t { cascade, duty };

/// Default: the bridge is off.
template <class Scalar>
struct DriveConfig {
  Mode mode = Mode::off;
  Chopping chopping = Chopping::soft;
  CurrentControl current_control = CurrentControl::pi;
  PiConfig<Scalar> current{};  ///< converts the current error in A to a voltage in V
  HysteresisConfig<Scalar> hysteresis{};
  Divisor<Scalar> nominal_bus_V{};  ///< the duty is u/nominal_bus_V, with the current loop's voltage u
  PiConfig<Scalar> speed{};  ///< converts the speed error in rad/s to a fraction of the torque limit; with
                             ///< SpeedControl::duty: to a duty
  Gain<Scalar> current_at_full_torque_A{};  ///< torque limit/K_t: the speed loop's output times this value is
                                            ///< the current reference
  Scalar current_limit_A{};      ///< bound of the speed loop's current reference; set `speed.limit` to the
                                 ///< same bound
  Gain<Scalar> position_gain{};  ///< speed reference in rad/s per degree of position error
  Scalar speed_limit_rad_s{};    ///< bound of the position loop's speed reference
  SpeedControl speed_control = SpeedControl::cascade;
  DriveExtras<Scalar> extras{};
  bool operator==(const DriveConfig&) const = default;
};

template <class Scalar>
struct DriveState {
  PiState<Scalar> current{}, speed{};
  HysteresisState<Scalar> hysteresis{};
  bool reversed = false;            ///< sign of the last command
  BridgeCommand<Scalar> command{};  ///< last result; on_hall() changes its pair
  DriveExtrasState<Scalar> extras{};
};

/// Intermediate values of the loops, for logs; the drive never reads them.
template <class Scalar>
struct Telemetry {
  Scalar motor_current_A{};
  Scalar current_reference_A{};
  Scalar speed_reference_rad_s{};
  Scalar duty{};  ///< with the command's sign
  [[no_unique_address]] ProfiledReference<Scalar> position{};
};

namespace detail {

template <class Scalar>
constexpr BridgeCommand<Scalar> bridge_off(bool fault) {
  BridgeCommand<Scalar> command{};
  command.fault = fault;
  return command;
}

/// Sets pair and duty: a negative d exchanges source and sink, and d = 0 counts as positive (model.md 3).
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

/// Reference of the speed loop: the setpoint, or in Mode::position the position loop's output.
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

/// Duty u/U_s with the measured or the nominal bus voltage; 0 if neither is configured.
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

/// Voltage u of the staying phase as a fraction of the bus voltage, limited to 0..1/2, or to 0..1 if legs may
/// overlap (commutation_step.hpp).
template <class Scalar>
constexpr Scalar holding_part(const DriveConfig<Scalar>& config, Scalar u,
                              const Measurement<Scalar>& measured) {
  const bool overlaps = Scalar{} < config.extras.commutation.overlap_bus_V;
  return between(duty_for(config, u, measured), Scalar{}, overlaps ? one<Scalar> : half_of_one<Scalar>());
}

/// Computes at each tick the duty to which the next commutation will step. It uses the tick's speed and
/// current, because on_hall() has no measurement. In modes without a current loop the duty does not step.
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

/// True while the leaving phase still conducts current. Meanwhile the duty keeps the staying phase's current
/// constant, and the current loop is not executed.
template <class Scalar>
constexpr bool holds_current(const DriveConfig<Scalar>& config, const DriveState<Scalar>& state) {
  return config.extras.on && config.extras.steps_commutation && state.extras.commutation.hands_over;
}

/// Sets the new pair, and state.part so that the staying phase's current moves towards its reference.
template <class Scalar>
constexpr void hold_towards(const DriveConfig<Scalar>& config, DriveState<Scalar>& state,
                            const Measurement<Scalar>& measured, Pair positive, Scalar i_ref) {
  state.command.pair = state.reversed ? swapped(positive) : positive;
  CommutationStepState<Scalar>& s = state.extras.commutation;
  const Scalar u = corrected_voltage(config.extras.commutation, s, state.reversed ? -i_ref : i_ref);
  s.part = between(holding_part(config, u, measured), Scalar{}, greatest_part(s.part));
}

/// Sets the duty and the overlap that keep the staying phase's current constant with the pair of
/// state.command.
template <class Scalar>
constexpr void hold_current(const DriveConfig<Scalar>& config, DriveState<Scalar>& state) {
  const CommutationStepState<Scalar>& held = state.extras.commutation;
  state.command.overlap = Scalar{};
  if (!holds_current(config, state) || !state.command.enabled) return;
  state.command.duty = holding_duty(held, state.command.pair, state.command.chopped);
  state.command.overlap = holding_overlap(held, state.command.pair);
}

/// Initial value of a slewed setpoint: the measurement in the unit of the mode.
template <class Scalar>
constexpr Scalar measured_value(Mode mode, const Measurement<Scalar>& measured, Scalar motor_current) {
  return mode == Mode::current    ? motor_current
         : mode == Mode::speed    ? measured.speed_rad_s
         : mode == Mode::position ? measured.position_deg
                                  : Scalar{};
}

/// Turns all gates off until the next tick. The loops keep their states.
template <class Scalar>
constexpr void coast(DriveState<Scalar>& state) {
  state.command.enabled = false;
  state.command.duty = Scalar{};
  state.command.watch = Watch::none;
}

/// Runs the loops of one tick, from the mode's loop to the innermost loop. The result is a pair with a duty,
/// or armed comparators.
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
  // While the gates are off, a current loop would have no effect and would only integrate the sensor's
  // offset.
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

/// One control tick in a mode that may differ from the configured mode (for example to brake). A cascade runs
/// from the outer to the inner loop with one sample (model.md 4). An invalid Hall code turns the bridge off
/// and reports a fault. Returns a reference into `state`, valid until the next call: on a chip a copy would
/// cost as much as the current loop.
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

/// One control tick in the configured mode. Call it once per PWM period.
template <class Scalar>
constexpr const BridgeCommand<Scalar>& step(const DriveConfig<Scalar>& config, DriveState<Scalar>& state,
                                            const Measurement<Scalar>& measured,
                                            const Setpoint<Scalar>& setpoint, Telemetry<Scalar>& telemetry) {
  return step_in(config.mode, config, state, measured, setpoint, telemetry);
}

/// The Hall interrupt: the bridge changes to the new pair at once, with the same duty and sign (model.md 3).
/// The PWM pattern selects the chopped switch. With a commutation step the duty changes to the value that
/// keeps the staying phase's current constant.
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
