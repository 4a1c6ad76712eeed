// SPDX-License-Identifier: Apache-2.0
// The field-oriented drive that firmware calls: position P -> speed PI -> currents along the magnet and across it ->
// three legs, as deep as the mode asks. One entry, once per control tick; a Hall edge asks nothing of it.
//
// The reference of Mode::current, and what a speed loop asks for, is i_q: the amplitude of the phase currents that make
// torque, T = 3/2 p psi i_q where the rotor is round. i_d* is what gives most torque per ampere and what weakens the field.
// In a cascade both together stay within current_limit_A: i_d comes first, and the speed PI is held to what is left, so
// that it does not wind up against it.
//
// Modulation is the symmetric space vector's; DriveConfig's chopping, current loop and bus voltage have no say here. What
// its extras may ask for are a slewed setpoint and another law of the speed loop.
#pragma once
#include "sixstep/control/field/field_current.hpp"
#include "sixstep/control/field/field_direction.hpp"
#include "sixstep/control/field/field_weakening.hpp"
#include "sixstep/control/field/torque_per_ampere.hpp"
#include "sixstep/control/retune.hpp"
#include "sixstep/control/three_phase_pwm.hpp"

namespace sixstep::control {

/// Every default leaves the bridge off.
template <class Scalar>
struct FieldDriveConfig {
  DriveConfig<Scalar> drive{};  ///< mode and the loops around the currents
  FieldCurrentConfig<Scalar> current{};
  FieldWeakeningConfig<Scalar> weakening{};
  TorquePerAmpereConfig<Scalar> per_ampere{};
  FieldAdvanceConfig<Scalar> advance{};
  bool operator==(const FieldDriveConfig&) const = default;
};

template <class Scalar>
struct FieldDriveState {
  DriveState<Scalar> drive{};
  FieldCurrentState<Scalar> current{};
  FieldWeakeningState<Scalar> weakening{};
  Dq<Scalar> measured{}, reference{};  ///< of the last tick, A
  LegCommands<Scalar> command{};       ///< the last answer
};

template <class Scalar>
struct FieldDriveInput {
  Measurement<Scalar> measured{};  ///< `hall` is not looked at
  FieldDirections<Scalar> magnet{};
};

namespace detail {

/// i_q to ask for, with what i_d leaves of the current limit, and a weakened field of the voltage.
template <class Scalar>
constexpr Scalar torque_current(const FieldDriveConfig<Scalar>& config, FieldDriveState<Scalar>& state,
                                const Measurement<Scalar>& measured, Scalar value,
                                Telemetry<Scalar>& telemetry) {
  using T = ScalarTraits<Scalar>;
  const DriveConfig<Scalar>& drive = config.drive;
  const auto bounded = [&](Scalar most) {
    return voltage_bound(config.weakening, config.current, measured.speed_rad_s, measured.bus_V, most);
  };
  if (drive.mode == Mode::current) return clamped(value, bounded(magnitude(value)));
  const Scalar w_ref = speed_reference(drive, drive.mode, value, measured);
  telemetry.speed_reference_rad_s = w_ref;
  const Scalar most = bounded(circle_rest(drive.current_limit_A, state.reference.d));
  const CurrentWindow<Scalar> window{-most, most};
  const Scalar y = speed_with_extras(drive.extras, state.drive.extras, drive.speed, state.drive.speed,
                                     w_ref - measured.speed_rad_s, measured.speed_rad_s, &window);
  return clamped(T::product(y, drive.current_at_full_torque_A), most);
}

template <class Scalar>
constexpr Scalar slewed(const DriveConfig<Scalar>& drive, DriveState<Scalar>& state,
                        const Measurement<Scalar>& measured, Scalar i_q, Scalar value) {
  if (!drive.extras.on) return value;
  return slewed_setpoint(drive.extras, state.extras, drive.mode, value,
                         measured_value(drive.mode, measured, i_q));
}

}  // namespace detail

/// One control tick. The answer lies in state.command, up to the next call. A duty is no mode of it: the bridge is off.
template <class Scalar>
constexpr const LegCommands<Scalar>& field_drive_step(const FieldDriveConfig<Scalar>& config,
                                                      FieldDriveState<Scalar>& state,
                                                      const FieldDriveInput<Scalar>& input,
                                                      const Setpoint<Scalar>& setpoint,
                                                      Telemetry<Scalar>& telemetry) {
  const Measurement<Scalar>& m = input.measured;
  if (config.drive.mode == Mode::off || config.drive.mode == Mode::duty) {
    state.drive.extras.slewing = Mode::off;
    state.command.enabled = false;
    return state.command;
  }
  state.measured = park(clarke(Abc<Scalar>{m.i_a_A, m.i_b_A, m.i_c_A}), input.magnet.sampled);
  const Scalar value = detail::slewed(config.drive, state.drive, m, state.measured.q, setpoint.value);
  const Scalar i_q = detail::torque_current(config, state, m, value, telemetry);
  const Scalar weakening =
      field_weakening_step(config.weakening, state.weakening, state.current.voltage, m.bus_V);
  state.reference = {least_current_d(config.per_ampere, i_q) + weakening, i_q};
  telemetry.motor_current_A = state.measured.q;
  telemetry.current_reference_A = i_q;
  const Dq<Scalar>& v = field_current_step(config.current, state.current, state.reference, state.measured,
                                           m.speed_rad_s, m.bus_V);
  state.command = space_vector(inverse_clarke(inverse_park(v, input.magnet.answered)), m.bus_V);
  return state.command;
}

/// Another configuration between two ticks (retune.hpp). What another mode did not run begins at rest.
template <class Scalar>
constexpr void retune(FieldDriveConfig<Scalar>& config, FieldDriveState<Scalar>& state,
                      const FieldDriveConfig<Scalar>& next) {
  if (next.drive.mode != config.drive.mode) {
    detail::rest_idle_loops(config.drive, state.drive);
    if (config.drive.mode == Mode::off || config.drive.mode == Mode::duty) {
      state.current = {};
      state.weakening = {};
      state.reference = {};
    }
  }
  detail::hand_speed_over(config.drive, state.drive, next.drive);
  config = next;
}

}  // namespace sixstep::control
