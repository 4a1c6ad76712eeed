// SPDX-License-Identifier: Apache-2.0
// Starts a drive without a rotor position sensor. Six pulses first find the rotor (pulse_position.hpp):
//
//   off -> catching -> pulses -> ramping        north was found: the ramp begins in the rotor's sector,
//                                               without alignment or oscillation
//                           '---> aligning      north was not found: the drive starts as without pulses
//                                               (sensorless.hpp)
//
// Call these functions instead of the functions of sensorless_drive.hpp. With pulse_ticks = 0 the result is
// that of sensorless_drive.hpp.
#pragma once
#include "sixstep/control/commissioning/pulse_position.hpp"
#include "sixstep/control/sensorless/sensorless_drive.hpp"

namespace sixstep::control {

template <class Scalar>
struct PulsedDriveConfig {
  SensorlessDriveConfig<Scalar> drive{};
  PulsePositionConfig pulses{};
  bool operator==(const PulsedDriveConfig&) const = default;
};

template <class Scalar>
struct PulsedDriveState {
  SensorlessDriveState<Scalar> drive{};
  PulsePositionState pulses{};
  PulsePositionReading found{};  ///< result of the last pulses
  bool pulsing = false;
};

template <class Scalar>
struct PulsedDriveInput {
  SensorlessDriveInput<Scalar> drive{};
  std::uint16_t current_counts[3]{};
};

/// Begins the ramp in the sector of `electrical`, with the field's angle equal to the rotor's angle within
/// this sector.
template <class Scalar>
constexpr void sensorless_ramp_from(const SensorlessConfig<Scalar>& config, SensorlessState& state,
                                    BinaryAngle electrical, std::uint32_t now) {
  state.sector = sector_of_angle(electrical);
  ramp_begin(config.start, state.start, now);
  const std::uint32_t passed = (electrical - sector_angle(state.sector)) * 6u;
  state.start.angle = state.direction < 0 ? ~passed : passed;
  detail::begin_sector(config, state, 0, now);
  state.phase = SensorlessPhase::ramping;
}

namespace detail {

/// One tick of the pulses; returns true when they are complete.
template <class Scalar>
constexpr bool pulsing_tick(const PulsedDriveConfig<Scalar>& config, PulsedDriveState<Scalar>& state,
                            const PulsedDriveInput<Scalar>& input) {
  pulses_tick(config.pulses, state.pulses, input.current_counts);
  BridgeCommand<Scalar>& command = state.drive.drive.command;
  command = BridgeCommand<Scalar>{};
  if (state.pulses.phase == PulsePhase::pulse) {
    command.enabled = true;
    command.pair = pulsed_pair(state.pulses);
    command.duty = one<Scalar>;
  }
  if (state.pulses.phase != PulsePhase::done) return false;
  const std::uint32_t now = input.drive.terminals.at;
  SensorlessState& rotor = state.drive.sensorless;
  state.pulsing = false;
  state.found = pulse_position(config.pulses, state.pulses);
  if (state.found.seen)
    sensorless_ramp_from(config.drive.sensorless, rotor, state.found.electrical, now);
  else
    begin_alignment(config.drive.sensorless, rotor, rotor.direction, now);
  return true;
}

}  // namespace detail

/// One control tick. Returns state.drive.drive.command, valid until the next call.
template <class Scalar>
constexpr const BridgeCommand<Scalar>& pulsed_drive_step(const PulsedDriveConfig<Scalar>& config,
                                                         PulsedDriveState<Scalar>& state,
                                                         const PulsedDriveInput<Scalar>& input,
                                                         const Setpoint<Scalar>& setpoint,
                                                         Telemetry<Scalar>& telemetry) {
  if (state.pulsing && !detail::pulsing_tick(config, state, input)) return state.drive.drive.command;
  const SensorlessPhase before = state.drive.sensorless.phase;
  sensorless_drive_step(config.drive, state.drive, input.drive, setpoint, telemetry);
  const bool begins =
      state.drive.sensorless.phase == SensorlessPhase::aligning && before != SensorlessPhase::aligning;
  if (begins && config.pulses.pulse_ticks > 0) {
    state.pulsing = true;
    state.drive.drive = DriveState<Scalar>{};
    pulses_begin(state.pulses);
  }
  return state.drive.drive.command;
}

}  // namespace sixstep::control
