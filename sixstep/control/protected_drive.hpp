// SPDX-License-Identifier: Apache-2.0
// The complete drive of a product: the input are register values, the output is a bridge command. In addition
// to drive.hpp it converts ADC counts, decodes the Hall pins, measures speed and position from the Hall
// edges, monitors faults and runs the state machine. Firmware calls protected_step() once per control tick
// and protected_on_hall() in the Hall interrupt.
#pragma once
#include <cstdint>

#include "sixstep/control/adc.hpp"
#include "sixstep/control/advance.hpp"
#include "sixstep/control/drive.hpp"
#include "sixstep/control/faults.hpp"
#include "sixstep/control/hall.hpp"
#include "sixstep/control/hall_speed.hpp"
#include "sixstep/control/one_shunt.hpp"
#include "sixstep/control/state_machine.hpp"

namespace sixstep::control {

enum class CurrentSensing : std::uint8_t { phases, one_shunt };

/// Alignment before the run: a fixed pair pulls the rotor, to check the wiring of phases and Hall probes. The
/// pair of sector s pulls the rotor to the angle where the pair's torque is 0. This angle is 90 degrees after
/// the middle of s, on the edge between sectors s + 1 and s + 2. Default: no alignment.
template <class Scalar>
struct AlignConfig {
  Scalar current_A{};
  std::uint32_t ticks = 0;          ///< longest duration; 0: no alignment
  std::uint32_t settled_ticks = 0;  ///< time for which the rotor must stay in sector s + 1 or s + 2
  std::uint8_t sector = 0;          ///< s: the sector whose pair pulls
  bool operator==(const AlignConfig&) const = default;
};

/// Default: the bridge is off.
template <class Scalar>
struct ProtectedConfig {
  DriveConfig<Scalar> drive{};
  Scalar setpoint_limit{};  ///< bound of |setpoint|, in the unit of the mode
  CurrentSensing sensing = CurrentSensing::phases;
  AdcConfig<Scalar> current_adc[3]{};  ///< converters of phases a, b, c; with one shunt only the first is
                                       ///< used
  AdcConfig<Scalar> bus_adc{};         ///< converter of the bus voltage; its offset is not measured
  OneShuntConfig<Scalar> shunt{};
  HallConfig hall{};  ///< if stable_samples is above 1, edges are evaluated in the tick, not in the interrupt
  HallSpeedConfig<Scalar> speed{};
  HallPositionConfig<Scalar> position{};
  AdvanceConfig<Scalar> advance{};
  FaultConfig<Scalar> faults{};
  AlignConfig<Scalar> align{};
  Scalar brake_current_A{};  ///< current against the rotation while braking; 0: the drive coasts instead
  /// Speed |w| up to which braking short-circuits the windings; 0: never. Choose it below brake_current_A
  /// R_tt/K_t, with the terminal resistance R_tt and the torque constant K_t.
  Scalar short_below_rad_s{};
  Scalar standing_rad_s{};  ///< speed |w| up to which the rotor counts as at rest, and braking ends
  bool operator==(const ProtectedConfig&) const = default;
};

/// Register values at one tick.
struct BoardInput {
  std::uint16_t current_counts[3]{};  ///< phases a, b, c; with one shunt only the first is used
  std::uint16_t bus_counts = 0;
  std::uint8_t hall_pins = 0;  ///< H1 H2 H3 as bits 2, 1, 0
  std::uint32_t now = 0;       ///< reading of the free-running counter that also captures Hall edges
};

template <class Scalar>
struct ProtectedState {
  DriveState<Scalar> drive{};
  AdcState current_adc[3]{};
  OneShuntState<Scalar> shunt{};
  HallState hall{};
  HallSpeedState speed{};
  HallPositionState position{};
  FaultState faults{};
  FaultEvents events{};  ///< events since the last tick
  ActivityState activity{};
  std::uint8_t pair_of = 0;  ///< Hall code whose pair carried the current at the last sample
  bool calibrated = false;
  std::uint32_t align_ticks = 0, align_settled = 0;
};

/// Values for a display or a log; the drive never reads them.
template <class Scalar>
struct ProtectedTelemetry {
  Telemetry<Scalar> drive{};
  Measurement<Scalar> measured{};
  Activity activity = Activity::off;
  std::uint16_t faults = 0;       ///< latched faults, bits of Fault
  std::uint16_t first_fault = 0;  ///< faults that stopped the drive, bits of Fault
  std::uint8_t hall_line = 0;     ///< 1..3: the faulty Hall line; 0: unknown
};

namespace detail {

template <class Scalar>
constexpr void take_hall(const ProtectedConfig<Scalar>& config, ProtectedState<Scalar>& state,
                         std::uint8_t pins, std::uint32_t when) {
  const SectorTime time = sector_time(state.speed, config.speed.grain_ticks, when);
  const HallReading reading = hall_step(config.hall, state.hall, pins, time);
  if (reading.fault != HallFault::none) state.events.hall = true;
  if (reading.line != 0) state.events.hall_line = reading.line;
  if (reading.moved == 0) return;
  state.events.moved = true;
  hall_speed_edge(state.speed, when, reading.moved);
  hall_position_edge(state.position, reading.moved);
}

/// Converts counts to a Measurement. `hall` is the code for the commutation: the next sector's code if its
/// edge is within the advance angle, and 000 if the sector is unknown.
template <class Scalar>
constexpr Measurement<Scalar> measure(const ProtectedConfig<Scalar>& config, ProtectedState<Scalar>& state,
                                      const BoardInput& input) {
  Measurement<Scalar> m{};
  m.speed_rad_s = hall_speed(config.speed, state.speed, input.now);
  const Scalar fraction = sector_fraction(config.speed, state.speed, input.now);
  m.position_deg = hall_position(config.position, state.position, state.speed.direction, fraction);
  m.bus_V = adc_value(config.bus_adc, AdcState{}, input.bus_counts);
  m.hall = hall_of_sector(
      advanced_sector(config.advance, state.hall.sector, state.speed.direction, fraction, m.speed_rad_s));
  const Scalar first = adc_value(config.current_adc[0], state.current_adc[0], input.current_counts[0]);
  if (config.sensing == CurrentSensing::phases) {
    m.i_a_A = first;
    m.i_b_A = adc_value(config.current_adc[1], state.current_adc[1], input.current_counts[1]);
    m.i_c_A = adc_value(config.current_adc[2], state.current_adc[2], input.current_counts[2]);
  } else if (m.hall != 0) {
    if (m.hall != state.pair_of) one_shunt_commutation(config.shunt, state.shunt);
    state.pair_of = m.hall;
    const BridgeCommand<Scalar>& now = state.drive.command;
    const Scalar i_m = one_shunt_step(config.shunt, state.shunt, state.drive.reversed,
                                      now.enabled ? now.duty : Scalar{}, first);
    set_phase_currents(m, positive_pair(sector_of_hall(m.hall)), i_m);
  }
  return m;
}

template <class Scalar>
constexpr void calibrate(const ProtectedConfig<Scalar>& config, ProtectedState<Scalar>& state,
                         const BoardInput& input) {
  const int channels = config.sensing == CurrentSensing::phases ? 3 : 1;
  bool done = true;
  for (int k = 0; k < channels; ++k) {
    if (state.current_adc[k].offset_eighths >= 0) continue;
    const Calibration result =
        adc_calibrate(config.current_adc[k], state.current_adc[k], input.current_counts[k]);
    done = done && result == Calibration::done;
    if (result == Calibration::failed)
      state.events.other = static_cast<std::uint16_t>(state.events.other | fault_calibration);
  }
  state.calibrated = done;
}

/// True when the rotor has stayed for settled_ticks in the sectors to which the pair pulls it. If the rotor
/// is not there after align.ticks, a fault is set.
template <class Scalar>
constexpr bool aligned(const ProtectedConfig<Scalar>& config, ProtectedState<Scalar>& state) {
  const AlignConfig<Scalar>& align = config.align;
  if (align.ticks == 0) return true;
  const std::uint8_t ahead = static_cast<std::uint8_t>((state.hall.sector + 6 - align.sector) % 6);
  state.align_settled = ahead == 1 || ahead == 2 ? state.align_settled + 1 : 0;
  if (state.align_settled > align.settled_ticks) return true;
  if (state.align_ticks >= align.ticks)
    state.events.other = static_cast<std::uint16_t>(state.events.other | fault_align);
  else
    ++state.align_ticks;
  return false;
}

/// Updates and clears faults, and returns the next activity.
template <class Scalar>
constexpr Activity decide(const ProtectedConfig<Scalar>& config, ProtectedState<Scalar>& state,
                          const Measurement<Scalar>& m, const Request& request) {
  const Activity was = state.activity.activity;
  ActivityInput in{.request = request};
  in.aligned = was == Activity::align && aligned(config, state);
  state.events.false_edge = state.hall.suspect;
  fault_step(config.faults, state.faults, m, state.events);
  state.events = FaultEvents{};
  if (clear_requested(state.activity, request) && fault_clear(state.faults)) state.calibrated = false;
  in.calibrated = state.calibrated;
  in.standing = magnitude(m.speed_rad_s) <= config.standing_rad_s;
  in.faulty = state.faults.latched != 0;
  const Activity now = activity_step(state.activity, in);
  if (now == was) return now;
  if (now == Activity::calibrate)
    for (AdcState& adc : state.current_adc) adc = AdcState{};
  if (now == Activity::align) state.align_ticks = state.align_settled = 0;
  if (now != Activity::brake && was != Activity::brake) state.drive = DriveState<Scalar>{};
  return now;
}

/// The setpoint, clamped to +-limit; 0 if it is NaN.
template <class Scalar>
constexpr Scalar limited_setpoint(Scalar x, Scalar limit) {
  return x >= -limit && x <= limit ? x : x > limit ? limit : x < -limit ? -limit : Scalar{};
}

/// Brakes with a constant current against the rotation. At low speed Hall edges are too rare to detect
/// standstill. The two lower switches then short-circuit the driven pair, whose torque decreases to 0 with
/// the speed and never reverses.
template <class Scalar>
constexpr const BridgeCommand<Scalar>& brake(const ProtectedConfig<Scalar>& config,
                                             ProtectedState<Scalar>& state, const Measurement<Scalar>& m,
                                             Telemetry<Scalar>& telemetry) {
  const Scalar slow = config.short_below_rad_s;
  telemetry = {};  // discards the values of the loops of the previous activity
  if (slow > Scalar{} && magnitude(m.speed_rad_s) <= slow) {
    step_in(Mode::duty, config.drive, state.drive, m, Setpoint<Scalar>{}, telemetry);
    state.drive.command.duty = Scalar{};
    if (state.drive.command.enabled) state.drive.command.chopping = Chopping::complementary;
    return state.drive.command;
  }
  if (!(config.brake_current_A > Scalar{})) return state.drive.command = bridge_off<Scalar>(false);
  const bool forward = m.speed_rad_s > Scalar{};
  const Scalar against = forward ? -config.brake_current_A : config.brake_current_A;
  return step_in(Mode::current, config.drive, state.drive, m, Setpoint<Scalar>{against}, telemetry);
}

template <class Scalar>
constexpr const BridgeCommand<Scalar>& act(const ProtectedConfig<Scalar>& config,
                                           ProtectedState<Scalar>& state, Activity activity,
                                           Measurement<Scalar>& m, Scalar setpoint,
                                           Telemetry<Scalar>& telemetry) {
  const DriveConfig<Scalar>& drive = config.drive;
  switch (activity) {
    case Activity::run:
      return step_in(drive.mode, drive, state.drive, m,
                     Setpoint<Scalar>{limited_setpoint(setpoint, config.setpoint_limit)}, telemetry);
    case Activity::brake:
      return brake(config, state, m, telemetry);
    case Activity::align:
      telemetry = {};
      if (config.align.ticks == 0) return state.drive.command = bridge_off<Scalar>(false);
      m.hall = hall_of_sector(config.align.sector);
      return step_in(Mode::current, drive, state.drive, m, Setpoint<Scalar>{config.align.current_A},
                     telemetry);
    default:
      telemetry = {};
      state.drive = DriveState<Scalar>{};
      state.drive.command.fault = activity == Activity::fault;
      return state.drive.command;
  }
}

}  // namespace detail

/// One control tick. Any fault turns the bridge off in the same tick and is latched until it is cleared.
/// Returns a reference into `state`, valid until the next call.
template <class Scalar>
constexpr const BridgeCommand<Scalar>& protected_step(const ProtectedConfig<Scalar>& config,
                                                      ProtectedState<Scalar>& state, const BoardInput& input,
                                                      const Request& request,
                                                      const Setpoint<Scalar>& setpoint,
                                                      ProtectedTelemetry<Scalar>& telemetry) {
  detail::take_hall(config, state, input.hall_pins, input.now);
  if (state.activity.activity == Activity::calibrate) detail::calibrate(config, state, input);
  Measurement<Scalar> m = detail::measure(config, state, input);
  const Activity activity = detail::decide(config, state, m, request);
  telemetry.measured = m;
  telemetry.activity = activity;
  telemetry.faults = state.faults.latched;
  telemetry.first_fault = state.faults.first;
  telemetry.hall_line = state.faults.hall_line;
  return detail::act(config, state, activity, m, setpoint.value, telemetry.drive);
}

/// The Hall interrupt: the bridge changes to the new pair while the drive runs or brakes. `pins`: levels
/// after the edge. `captured`: the counter's reading at the edge. An invalid code or a jump turns the bridge
/// off at once; the next tick reports the fault.
template <class Scalar>
constexpr const BridgeCommand<Scalar>& protected_on_hall(const ProtectedConfig<Scalar>& config,
                                                         ProtectedState<Scalar>& state, std::uint8_t pins,
                                                         std::uint32_t captured) {
  if (config.hall.stable_samples > 1) return state.drive.command;
  detail::take_hall(config, state, pins, captured);
  if (state.events.hall) {
    state.drive.command = detail::bridge_off<Scalar>(true);
    return state.drive.command;
  }
  const Activity activity = state.activity.activity;
  if (activity == Activity::run || activity == Activity::brake)
    return on_hall(config.drive, state.drive, hall_of_sector(state.hall.sector));
  return state.drive.command;
}

}  // namespace sixstep::control
