// SPDX-License-Identifier: Apache-2.0
// Position without a sensor: computes speed, position and the code of Hall probes from the terminal voltages.
// drive.hpp uses this code as a Hall code; the timer's compare match replaces the Hall interrupt.
//
//   off -> catching -> aligning -> ramping -> running        if the setpoint has a direction
//           |  ^-------------------------------- lost         (lock.hpp); gave_up after more than lock.retries losses
//           '-> running                                        if the rotor already turns (spin.hpp)
//
// In phase `following` the Hall probes commutate. Crossings are only recorded, so that the back-EMF can
// replace the probes while the motor turns.
//
// Call sensorless_step once per control tick with the samples of that tick. Call sensorless_commutate when
// the timer reaches state.clock.next while state.clock.scheduled. If a commutation is already due when its
// crossing is found, the step commutates. With comparators at the terminals, call sensorless_capture at each
// of their edges.
#pragma once
#include <cstdint>

#include "sixstep/control/sensorless/sensorless_phases.hpp"

namespace sixstep::control {

/// Commands for the drive in the present phase.
template <class Scalar>
struct SensorlessAnswer {
  bool drives = false;    ///< true: the drive is on; false: the bridge is off
  bool by_start = false;  ///< true: the current loop controls the current to start_A, in every mode and for
                          ///< any setpoint
  Scalar start_A{};       ///< current of the start, with the sign of its direction
};

/// The timer's compare match: begins the next sector.
template <class Scalar>
constexpr void sensorless_commutate(const SensorlessConfig<Scalar>& config, SensorlessState& state,
                                    std::uint32_t now) {
  detail::begin_sector(config, state, state.direction, now);
  if (state.phase == SensorlessPhase::ramping) ramp_commutated(state.start);
}

/// The capture interrupt of comparators at the terminals. `lines`: levels of the three comparators from `at`
/// on.
constexpr void sensorless_capture(SensorlessState& state, std::uint8_t lines, std::uint32_t at) {
  capture_lines(state.captured, lines, at);
}

/// One control tick.
template <class Scalar>
constexpr void sensorless_step(const SensorlessConfig<Scalar>& config, SensorlessState& state,
                               const SensorlessInput& input) {
  const std::uint32_t now = input.terminals.at;
  switch (state.phase) {
    case SensorlessPhase::gave_up:
      if (input.wanted == 0) {
        state.lock = LockState{};
        state.phase = SensorlessPhase::off;
      }
      return;
    case SensorlessPhase::off:
      if (input.wanted == 0) return;
      if (config.spin.listen_ticks > 0) return detail::catch_spin(state, now);
      return detail::begin_alignment(config, state, input.wanted, now);
    case SensorlessPhase::catching:
      detail::catching_step(config, state, input);
      break;
    case SensorlessPhase::aligning:
      return detail::aligning_step(config, state, input);
    case SensorlessPhase::ramping:
      detail::ramping_step(config, state, input);
      break;
    case SensorlessPhase::running:
      detail::running_step(config, state, input);
      detail::commutate_by_level(state, input);
      break;
    case SensorlessPhase::following:
      return;
  }
  if (state.clock.scheduled && !comes_before(now, state.clock.next)) sensorless_commutate(config, state, now);
}

/// Processes a Hall edge into `sector` while the Hall probes commutate.
template <class Scalar>
constexpr void sensorless_follow_edge(const SensorlessConfig<Scalar>& config, SensorlessState& state,
                                      std::uint8_t sector, std::int8_t moved, std::uint32_t now) {
  if (moved != 0 && moved != state.direction) state.clock = CommutationClockState{};
  if (moved != 0) state.direction = moved;
  state.sector = sector;
  detail::begin_sector(config, state, 0, now);
  state.position.sectors += moved;
}

/// A control tick while the Hall probes commutate: finds crossings and schedules commutations as if the
/// back-EMF commutated.
template <class Scalar>
constexpr void sensorless_follow(const SensorlessConfig<Scalar>& config, SensorlessState& state,
                                 const SensorlessInput& input) {
  state.phase = SensorlessPhase::following;
  const CrossingReading reading = detail::crossing_of(config, state, input);
  if (reading.crossing == Crossing::seen) detail::take_crossing(config, state, reading.at);
}

/// Commands for the drive now.
template <class Scalar>
constexpr SensorlessAnswer<Scalar> sensorless_answer(const SensorlessConfig<Scalar>& config,
                                                     const SensorlessState& state, std::int8_t wanted) {
  const StartUpConfig<Scalar>& start = config.start;
  const auto in_direction = [](Scalar x, std::int8_t direction) { return direction < 0 ? -x : x; };
  switch (state.phase) {
    case SensorlessPhase::aligning:
      return {true, true,
              in_direction(state.start.falls ? start.falling_A : start.current_A, state.direction)};
    case SensorlessPhase::ramping:
      return {true, true, in_direction(start.current_A, state.direction)};
    case SensorlessPhase::running:
      // A rotor that already turns in the opposite direction is braked first.
      return {true, wanted == -state.direction, in_direction(start.current_A, wanted)};
    default:
      return {};
  }
}

/// Mechanical speed from the crossings, rad/s; 0 while the rotor is not followed.
template <class Scalar>
constexpr Scalar sensorless_speed(const SensorlessConfig<Scalar>& config, SensorlessState& state,
                                  std::uint32_t now) {
  return hall_speed(config.speed, state.clock.crossings, now);
}

/// Mechanical position, degrees, relative to the start of the drive: counted sectors, interpolated by time.
template <class Scalar>
constexpr Scalar sensorless_position(const SensorlessConfig<Scalar>& config, const SensorlessState& state,
                                     std::uint32_t now) {
  const std::uint32_t T = sector_ticks(config.clock, state.clock);
  const Scalar way =
      T == 0 ? ScalarTraits<Scalar>::fraction(1, 2)
             : ScalarTraits<Scalar>::fraction(static_cast<std::uint32_t>(now - state.commutated_at), T);
  return hall_position(config.position, state.position, state.direction, way);
}

}  // namespace sixstep::control
