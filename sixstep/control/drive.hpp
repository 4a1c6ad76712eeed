// SPDX-License-Identifier: Apache-2.0
// The composition that firmware calls: position P -> speed PI -> current loop -> six-step, as deep as the
// mode asks. Two entries: step() once per control tick, on_hall() in the Hall interrupt.
#pragma once
#include "sixstep/control/bridge_command.hpp"
#include "sixstep/control/commutation.hpp"
#include "sixstep/control/hysteresis.hpp"
#include "sixstep/control/pi.hpp"

namespace sixstep::control {

enum class CurrentControl : std::uint8_t { pi, hysteresis };

/// Every default leaves the bridge off.
template <class Scalar>
struct DriveConfig {
  Mode mode = Mode::off;
  Chopping chopping = Chopping::soft;
  CurrentControl current_control = CurrentControl::pi;
  PiConfig<Scalar> current{};  ///< A -> V
  HysteresisConfig<Scalar> hysteresis{};
  Scalar nominal_bus_V{};             ///< d = u / nominal_bus_V
  PiConfig<Scalar> speed{};           ///< rad/s -> fraction of the torque limit
  Scalar current_at_full_torque_A{};  ///< torque limit / K_t: i_ref = y * this
  Scalar current_limit_A{};           ///< of the reference a speed loop gives
  Scalar position_gain{};             ///< degrees -> rad/s
  Scalar speed_limit_rad_s{};         ///< of the reference a position loop gives
};

template <class Scalar>
struct DriveState {
  PiState<Scalar> current{}, speed{};
  HysteresisState<Scalar> hysteresis{};
  bool reversed = false;            ///< sign of the last command
  BridgeCommand<Scalar> command{};  ///< the last answer; on_hall moves it to the new pair
};

/// What the loops had in hand; nobody reads it back.
template <class Scalar>
struct Telemetry {
  Scalar motor_current_A{};
  Scalar current_reference_A{};
  Scalar speed_reference_rad_s{};
  Scalar duty{};  ///< signed
};

namespace detail {

template <class Scalar>
constexpr BridgeCommand<Scalar> bridge_off(bool fault) {
  BridgeCommand<Scalar> command{};
  command.fault = fault;
  return command;
}

/// d < 0 swaps source and sink; d = 0 counts as positive (MODEL 3).
template <class Scalar>
constexpr void set_duty(DriveState<Scalar>& state, Pair positive, Scalar d) {
  state.reversed = d < Scalar(0);
  state.command.pair = state.reversed ? swapped(positive) : positive;
  state.command.duty = state.reversed ? -d : d;
  state.command.watch = Watch::none;
}

template <class Scalar>
constexpr void arm_hysteresis(const DriveConfig<Scalar>& config, DriveState<Scalar>& state, Pair positive,
                              Scalar motor_current, Scalar reference) {
  const bool reversed = reference < Scalar(0);
  const Scalar level = reversed ? -reference : reference;
  state.reversed = reversed;
  state.command.pair = reversed ? swapped(positive) : positive;
  state.command.watch = config.hysteresis.watch;
  state.command.on_below_A = level - config.hysteresis.band_A;
  state.command.off_above_A = level + config.hysteresis.band_A;
  if (config.hysteresis.watch == Watch::none) {
    const Scalar current = reversed ? -motor_current : motor_current;
    state.command.duty =
        hysteresis_step(config.hysteresis, state.hysteresis, current, level) ? Scalar(1) : Scalar(0);
  }
}

template <class Scalar>
constexpr Scalar speed_to_current(const DriveConfig<Scalar>& config, DriveState<Scalar>& state,
                                  Scalar speed_reference, Scalar speed) {
  const Scalar fraction = pi_step(config.speed, state.speed, speed_reference - speed);
  return clamped(fraction * config.current_at_full_torque_A, config.current_limit_A);
}

}  // namespace detail

/// One control tick. A cascade runs outer to inner from one sample (MODEL 4). An impossible Hall code turns
/// the bridge off and reports a fault.
template <class Scalar>
constexpr BridgeCommand<Scalar> step(const DriveConfig<Scalar>& config, DriveState<Scalar>& state,
                                     const Measurement<Scalar>& measured, const Setpoint<Scalar>& setpoint,
                                     Telemetry<Scalar>& telemetry) {
  const std::uint8_t sector = sector_of_hall(measured.hall);
  if (config.mode == Mode::off || sector == no_sector) {
    state.command = detail::bridge_off<Scalar>(sector == no_sector);
    return state.command;
  }
  const Pair positive = positive_pair(sector);
  const Scalar i_m = motor_current(measured, positive);
  state.command.enabled = true;
  state.command.chopping = config.chopping;
  telemetry.motor_current_A = i_m;
  if (config.mode == Mode::duty) {
    detail::set_duty(state, positive, clamped(setpoint.value, Scalar(1)));
  } else {
    Scalar i_ref = setpoint.value;
    if (config.mode != Mode::current) {
      Scalar w_ref = setpoint.value;
      if (config.mode == Mode::position)
        w_ref = clamped(config.position_gain * (setpoint.value - measured.position_deg),
                        config.speed_limit_rad_s);
      telemetry.speed_reference_rad_s = w_ref;
      i_ref = detail::speed_to_current(config, state, w_ref, measured.speed_rad_s);
    }
    telemetry.current_reference_A = i_ref;
    if (config.current_control == CurrentControl::hysteresis)
      detail::arm_hysteresis(config, state, positive, i_m, i_ref);
    else
      detail::set_duty(
          state, positive,
          clamped(pi_step(config.current, state.current, i_ref - i_m) / config.nominal_bus_V, Scalar(1)));
  }
  telemetry.duty = state.reversed ? -state.command.duty : state.command.duty;
  return state.command;
}

/// The Hall interrupt: the present state moves to the new pair at once; duty and sign stay (MODEL 3).
template <class Scalar>
constexpr BridgeCommand<Scalar> on_hall(const DriveConfig<Scalar>& config, DriveState<Scalar>& state,
                                        std::uint8_t code) {
  const std::uint8_t sector = sector_of_hall(code);
  if (config.mode == Mode::off || sector == no_sector) {
    state.command = detail::bridge_off<Scalar>(sector == no_sector);
    return state.command;
  }
  const Pair positive = positive_pair(sector);
  state.command.pair = state.reversed ? swapped(positive) : positive;
  return state.command;
}

}  // namespace sixstep::control
