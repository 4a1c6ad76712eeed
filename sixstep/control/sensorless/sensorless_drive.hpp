// SPDX-License-Identifier: Apache-2.0
// Runs the drive of drive.hpp without a rotor position sensor. Firmware calls
//   sensorless_drive_step       once per control tick
//   sensorless_drive_commutate  when the timer reaches next_commutation
//   sensorless_drive_hall       in the Hall interrupt, if the motor also has probes
//   sensorless_capture          (sensorless.hpp) in the interrupt of comparators
//
// During the start the current loop controls the start's current in every mode. At the end of the start the
// loops continue from this state. The speed loop's output begins at the part of the start's current that the
// ramp needed, because the rest was a reserve. A current or duty setpoint changes by a limited step per tick.
// This limit always applies, because a step of the setpoint could cause a current that hides the crossings.
#pragma once
#include "sixstep/control/drive.hpp"
#include "sixstep/control/retune.hpp"
#include "sixstep/control/sensorless/position_source.hpp"

namespace sixstep::control {

template <class Scalar>
struct SensorlessDriveConfig {
  DriveConfig<Scalar> drive{};
  SensorlessConfig<Scalar> sensorless{};
  PositionSourceConfig source{};
  ObserverConfig<Scalar> observer{};  ///< source of the back-EMF
  Scalar start_output{};              ///< initial output of the speed loop after the start, computed from the
                                      ///< ramp's torque
  SlewConfig<Scalar> duty{};          ///< change of a duty setpoint per tick; default: no limit
  SlewConfig<Scalar> current{};       ///< change of a current setpoint per tick; default: no limit
  Scalar least_duty{};  ///< least duty while the rotor is followed, because a crossing is visible only in the
                        ///< on-time
  bool operator==(const SensorlessDriveConfig&) const = default;
};

template <class Scalar>
struct SensorlessDriveState {
  DriveState<Scalar> drive{};
  SensorlessState sensorless{};
  PositionSourceState source{};
  ObserverState<Scalar> observer{};
  SlewState<Scalar> setpoint{};
  bool by_start = true;  ///< true: the start determined the current at the last tick
};

/// Values of the registers at a tick. `measured` contains currents and bus, and with Hall probes also speed
/// and position.
template <class Scalar>
struct SensorlessDriveInput {
  Measurement<Scalar> measured{};
  TerminalSample terminals{};
  std::uint8_t hall_pins = 0;
  bool on = false;             ///< true: the pair's switches are on at the sample
  std::uint32_t on_ticks = 0;  ///< timer ticks of the on-time around the sample; for comparators with half
                               ///< the bus as the reference
};

namespace detail {

/// Direction of rotation that the setpoint requires: 1, -1, or 0 for standstill.
template <class Scalar>
constexpr std::int8_t wanted_direction(const DriveConfig<Scalar>& config, Scalar setpoint, Scalar position) {
  if (config.mode == Mode::off) return 0;
  const Scalar zero{};
  const Scalar way = config.mode == Mode::position ? setpoint - position : setpoint;
  return way > zero ? std::int8_t{1} : way < zero ? std::int8_t{-1} : std::int8_t{0};
}

/// Sets the states of the loops so that the loops continue from the end of the start.
template <class Scalar>
constexpr void hand_over(const SensorlessDriveConfig<Scalar>& config, SensorlessDriveState<Scalar>& state,
                         const Measurement<Scalar>& measured, Scalar setpoint, bool forward, bool caught) {
  using T = ScalarTraits<Scalar>;
  const DriveConfig<Scalar>& drive = config.drive;
  const Scalar duty = caught                 ? Scalar{}
                      : state.drive.reversed ? -state.drive.command.duty
                                             : state.drive.command.duty;
  const Scalar current = caught    ? Scalar{}
                         : forward ? config.sensorless.start.current_A
                                   : -config.sensorless.start.current_A;
  state.setpoint.y = T::accumulator(drive.mode == Mode::duty ? duty : current);
  const Scalar output = caught ? Scalar{} : forward ? config.start_output : -config.start_output;
  state.drive.speed.u = T::accumulator(drive.speed_control == SpeedControl::duty ? duty : output);
  state.drive.speed.e =
      speed_reference(drive, state.drive, drive.mode, setpoint, measured) - measured.speed_rad_s;
}

/// Raises the duty to least_duty, so that a sample is possible within the pulse.
template <class Scalar>
constexpr void keep_visible(Scalar least_duty, BridgeCommand<Scalar>& command) {
  if (command.enabled && command.watch == Watch::none && command.duty < least_duty) command.duty = least_duty;
}

/// The duty or current setpoint, with a limited change per tick so that the crossings stay visible.
template <class Scalar>
constexpr Scalar approached(const SensorlessDriveConfig<Scalar>& config, SensorlessDriveState<Scalar>& state,
                            Scalar setpoint) {
  const Mode mode = config.drive.mode;
  if (mode != Mode::duty && mode != Mode::current) return setpoint;
  const SlewConfig<Scalar>& slew = mode == Mode::duty ? config.duty : config.current;
  if (slew.step == Accumulator<Scalar>{}) return setpoint;
  return slew_step(slew, state.setpoint, setpoint);
}

}  // namespace detail

/// One control tick. Returns state.drive.command, valid until the next call.
template <class Scalar>
constexpr const BridgeCommand<Scalar>& sensorless_drive_step(const SensorlessDriveConfig<Scalar>& config,
                                                             SensorlessDriveState<Scalar>& state,
                                                             const SensorlessDriveInput<Scalar>& input,
                                                             const Setpoint<Scalar>& setpoint,
                                                             Telemetry<Scalar>& telemetry) {
  SensorlessState& rotor = state.sensorless;
  Measurement<Scalar> measured = input.measured;
  const std::uint32_t now = input.terminals.at;
  source_step(config.source, config.sensorless, state.source, rotor, input.hall_pins, now);
  const Observed observed = observer_step(config.observer, state.observer, input.terminals,
                                          state.drive.command, measured, rotor.sector);
  if (state.source.source == RotorSource::hall) {
    sensorless_follow(config.sensorless, rotor, {input.terminals, 0, input.on, input.on_ticks});
    state.by_start = false;
    measured.hall = state.source.broken ? std::uint8_t{0}
                                        : as_120_degrees(config.source.hall.arrangement, input.hall_pins);
    return step(config.drive, state.drive, measured, setpoint, telemetry);
  }
  const std::int8_t wanted = detail::wanted_direction(config.drive, setpoint.value,
                                                      sensorless_position(config.sensorless, rotor, now));
  const bool from_ramp = rotor.phase == SensorlessPhase::ramping;
  sensorless_step(config.sensorless, rotor, {input.terminals, wanted, input.on, input.on_ticks, observed});
  const SensorlessAnswer<Scalar> answer = sensorless_answer(config.sensorless, rotor, wanted);
  measured.hall = hall_of_sector(rotor.sector);
  // The observer reports a crossing only after lag_ticks. The speed is therefore computed for the earlier
  // instant `told`, at which the next crossing is not yet overdue.
  const std::uint32_t told = now - observed.lag_ticks, last = rotor.clock.crossings.times[0];
  measured.speed_rad_s = sensorless_speed(config.sensorless, rotor, comes_before(told, last) ? last : told);
  measured.position_deg = sensorless_position(config.sensorless, rotor, now);
  if (!answer.drives) {
    state.drive = DriveState<Scalar>{};
    state.drive.command.fault = rotor.phase == SensorlessPhase::gave_up;
    state.by_start = true;
    return state.drive.command;
  }
  if (answer.by_start) {
    step_in(Mode::current, config.drive, state.drive, measured, {answer.start_A}, telemetry);
  } else {
    if (state.by_start)
      detail::hand_over(config, state, measured, setpoint.value, rotor.direction > 0, !from_ramp);
    step(config.drive, state.drive, measured, {detail::approached(config, state, setpoint.value)}, telemetry);
  }
  state.by_start = answer.by_start;
  if (rotor.phase == SensorlessPhase::running) detail::keep_visible(config.least_duty, state.drive.command);
  return state.drive.command;
}

/// Changes the pair when the timer has reached next_commutation.
template <class Scalar>
constexpr const BridgeCommand<Scalar>& sensorless_drive_commutate(const SensorlessDriveConfig<Scalar>& config,
                                                                  SensorlessDriveState<Scalar>& state,
                                                                  std::uint32_t now) {
  sensorless_commutate(config.sensorless, state.sensorless, now);
  if (!state.drive.command.enabled) return state.drive.command;
  const Pair positive = positive_pair(state.sensorless.sector);
  state.drive.command.pair = state.drive.reversed ? swapped(positive) : positive;
  return state.drive.command;
}

/// True if a commutation is scheduled; `at` is the timer's reading at which it is due.
template <class Scalar>
constexpr bool next_commutation(const SensorlessDriveState<Scalar>& state, std::uint32_t& at) {
  const SensorlessPhase phase = state.sensorless.phase;
  at = state.sensorless.clock.next;
  return state.sensorless.clock.scheduled &&
         (phase == SensorlessPhase::ramping || phase == SensorlessPhase::running);
}

/// The Hall interrupt. Returns true if it changed the pair.
template <class Scalar>
constexpr bool sensorless_drive_hall(const SensorlessDriveConfig<Scalar>& config,
                                     SensorlessDriveState<Scalar>& state, std::uint8_t pins,
                                     std::uint32_t captured) {
  if (!source_hall_edge(config.source, config.sensorless, state.source, state.sensorless, pins, captured))
    return false;
  on_hall(config.drive, state.drive, as_120_degrees(config.source.hall.arrangement, pins));
  return true;
}

/// Replaces the configuration between two ticks (retune.hpp). The drive continues to follow the rotor.
template <class Scalar>
constexpr void retune(SensorlessDriveConfig<Scalar>& config, SensorlessDriveState<Scalar>& state,
                      const SensorlessDriveConfig<Scalar>& next) {
  if (next.drive.mode != config.drive.mode) detail::rest_idle_loops(config.drive, state.drive);
  detail::hand_speed_over(config.drive, state.drive, next.drive);
  config = next;
}

}  // namespace sixstep::control
