// SPDX-License-Identifier: Apache-2.0
// Computes the leg commands of a field-oriented drive: position P -> speed PI -> currents along the magnet
// and across it -> three legs. The mode selects the loop at which the chain begins. Firmware calls
// field_drive_step() once per control tick; a Hall edge needs no call.
//
// The reference of Mode::current, and the output of the speed loop, is i_q: the amplitude of the phase
// currents that produce torque. For a round rotor the torque is 3/2 p psi i_q, with pole pairs p and flux
// linkage psi. The reference of i_d is the sum of two currents: the current of most torque per ampere, and
// the current that weakens the field.
//
// If the back-EMF is not sinusoidal, i_d and i_q may follow its shape (harmonic_current.hpp). The reference
// is then the constant i_q with the same mean torque. In a cascade the vector of i_d and i_q is limited to
// current_limit_A. i_d has priority. The remainder limits the speed PI, so that the PI does not wind up.
//
// Two PIs with symmetric space-vector modulation control the currents. Alternatively the drive chooses one of
// the eight states of three legs (finite_set.hpp). The chopping, current loop and bus voltage of DriveConfig
// are not used. Of DriveConfig's extras, only a slewed or profiled setpoint and another law of the speed loop
// are used.
#pragma once
#include "sixstep/control/field/field_current.hpp"
#include "sixstep/control/field/field_direction.hpp"
#include "sixstep/control/field/field_weakening.hpp"
#include "sixstep/control/field/finite_set.hpp"
#include "sixstep/control/field/harmonic_current.hpp"
#include "sixstep/control/field/reachable_current.hpp"
#include "sixstep/control/field/torque_per_ampere.hpp"
#include "sixstep/control/retune.hpp"
#include "sixstep/control/three_phase_pwm.hpp"

namespace sixstep::control {

/// Default: Mode::off, the bridge is off.
template <class Scalar>
struct FieldDriveConfig {
  DriveConfig<Scalar> drive{};  ///< mode and outer loops (speed, position)
  FieldCurrentConfig<Scalar> current{};
  FieldWeakeningConfig<Scalar> weakening{};
  TorquePerAmpereConfig<Scalar> per_ampere{};
  FieldAdvanceConfig<Scalar> advance{};
  HarmonicCurrentConfig<Scalar> harmonic{};
  FiniteSetConfig<Scalar> finite_set{};
  bool operator==(const FieldDriveConfig&) const = default;
};

template <class Scalar>
struct FieldDriveState {
  DriveState<Scalar> drive{};
  FieldCurrentState<Scalar> current{};
  FieldWeakeningState<Scalar> weakening{};
  FiniteSetState<Scalar> finite_set{};
  Dq<Scalar> measured{}, reference{};  ///< currents at the last tick, in the rotor's frame, A
  LegCommands<Scalar> command{};       ///< command of the last tick
};

template <class Scalar>
struct FieldDriveInput {
  Measurement<Scalar> measured{};  ///< `hall` is not used
  FieldDirections<Scalar> magnet{};
};

namespace detail {

/// Limit of i_q, A: the part of the current limit that i_d does not use.
template <class Scalar>
constexpr Scalar current_left(const FieldDriveConfig<Scalar>& config, const FieldDriveState<Scalar>& state) {
  const Scalar limit = config.drive.current_limit_A;
  if (!config.harmonic.on) return circle_rest(limit, state.reference.d);
  return config.harmonic.least * circle_rest(limit, ScalarTraits<Scalar>::signal(state.weakening.i_d));
}

/// Coupling of the axes, V. For a back-EMF that is not sinusoidal, the coupling is computed for the instant
/// at which the output acts. It then uses the magnet's voltage at this instant, and the measured current plus
/// the reference's change until this instant.
template <class Scalar>
constexpr Dq<Scalar> turning(const FieldDriveConfig<Scalar>& config, const FieldDriveState<Scalar>& state,
                             BinaryAngle magnet, Scalar speed_rad_s, Scalar i_q, Scalar weakening) {
  if (!config.current.decouples) return {};
  if (!config.harmonic.on) return turning_voltage(config.current, state.measured, speed_rad_s);
  const BinaryAngle answered = turned_on(magnet, speed_rad_s, config.advance.rad_s);
  const TakenAlong<Scalar> to = taken_along(config.harmonic, answered, speed_rad_s, i_q, weakening);
  const Dq<Scalar> then{state.measured.d + (to.current.d - state.reference.d),
                        state.measured.q + (to.current.q - state.reference.q)};
  const Dq<Scalar> e =
      turning_voltage(config.current, then, speed_rad_s,
                      harmonic_voltage(config.harmonic, answered, speed_rad_s, config.current.magnet_V_s));
  return {e.d + to.voltage.d, e.q + to.voltage.q};
}

/// Voltage, V, that the magnet at angle `magnet` induces along its axis and across.
template <class Scalar>
constexpr Dq<Scalar> magnet_voltage(const FieldDriveConfig<Scalar>& config, BinaryAngle magnet,
                                    Scalar speed_rad_s) {
  const auto psi = config.current.magnet_V_s;
  if (config.harmonic.on) return harmonic_voltage(config.harmonic, magnet, speed_rad_s, psi);
  return {Scalar{}, ScalarTraits<Scalar>::product(speed_rad_s, psi)};
}

/// Chooses the states of the three legs for a whole period; no pulses are modulated.
template <class Scalar>
constexpr const LegCommands<Scalar>& choose_legs(const FieldDriveConfig<Scalar>& config,
                                                 FieldDriveState<Scalar>& state,
                                                 const FieldDriveInput<Scalar>& input) {
  const FiniteSetConfig<Scalar>& c = config.finite_set;
  const Measurement<Scalar>& m = input.measured;
  const BinaryAngle middle = turned_on(input.magnet.angle, m.speed_rad_s, c.half_turn_s);
  BinaryAngle next = middle;
  if (c.foretells)
    next = turned_on(turned_on(middle, m.speed_rad_s, c.half_turn_s), m.speed_rad_s, c.half_turn_s);
  const LegBits legs = finite_set_step(c, state.finite_set,
                                       {.reference = state.reference,
                                        .measured = state.measured,
                                        .magnet = input.magnet.sampled,
                                        .speed_rad_s = m.speed_rad_s,
                                        .bus_V = m.bus_V,
                                        .e = magnet_voltage(config, middle, m.speed_rad_s),
                                        .e_next = magnet_voltage(config, next, m.speed_rad_s)});
  state.current.voltage = park(legs_voltage(legs, m.bus_V), input.magnet.answered);
  state.command = as_legs<Scalar>(legs);
  return state.command;
}

/// Reference of i_q, A. Two limits apply: the part of the current limit that i_d does not use and, if the
/// field is weakened, the available voltage.
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
  const Scalar w_ref = speed_reference(drive, state.drive, drive.mode, value, measured);
  telemetry.speed_reference_rad_s = w_ref;
  const Scalar most = bounded(current_left(config, state));
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
                         measured_value(drive.mode, measured, i_q), measured.speed_rad_s);
}

/// Results of the outer loops, A: the torque part of state.reference, and the part that weakens the field.
template <class Scalar>
struct FieldAsked {
  Scalar i_q{}, weakening{};
};
template <class Scalar>
constexpr FieldAsked<Scalar> field_asked(const FieldDriveConfig<Scalar>& config,
                                         FieldDriveState<Scalar>& state, const Measurement<Scalar>& m,
                                         BinaryAngle magnet, const Setpoint<Scalar>& setpoint,
                                         Telemetry<Scalar>& telemetry) {
  const Scalar value = slewed(config.drive, state.drive, m, state.measured.q, setpoint.value);
  if (config.drive.extras.on) tell_profile(config.drive.extras, state.drive.extras, value, telemetry);
  const Scalar i_q = torque_current(config, state, m, value, telemetry);
  const Scalar weakening =
      field_weakening_step(config.weakening, state.weakening, state.current.voltage, m.bus_V);
  telemetry.motor_current_A = state.measured.q;
  telemetry.current_reference_A = i_q;
  const Dq<Scalar> wanted{least_current_d(config.per_ampere, i_q) + weakening, i_q};
  state.reference = reachable_current(config.current, wanted, m.speed_rad_s, m.bus_V);
  const FieldAsked<Scalar> asked{state.reference.q, state.reference.d};
  if (config.harmonic.on)
    state.reference = harmonic_current(config.harmonic, magnet, m.speed_rad_s, asked.i_q, asked.weakening);
  return asked;
}

/// Computes the phase voltages, V, in the rotor's frame, from the currents in state.measured.
template <class Scalar>
constexpr const Dq<Scalar>& field_voltage(const FieldDriveConfig<Scalar>& config,
                                          FieldDriveState<Scalar>& state, const Measurement<Scalar>& m,
                                          BinaryAngle magnet, const FieldAsked<Scalar>& asked) {
  const Dq<Scalar> e = turning(config, state, magnet, m.speed_rad_s, asked.i_q, asked.weakening);
  return field_current_beside(config.current, state.current, state.reference, state.measured, e,
                              m.speed_rad_s, m.bus_V);
}

}  // namespace detail

/// One control tick. Returns state.command, valid until the next call. In Mode::duty, which is not possible
/// with three legs, the bridge is off. Inlining lets the compiler remove unused parts of a constant
/// configuration, which saves 2 KB on a Cortex-M4.
template <class Scalar>
[[gnu::always_inline]] constexpr const LegCommands<Scalar>& field_drive_step(
    const FieldDriveConfig<Scalar>& config, FieldDriveState<Scalar>& state,
    const FieldDriveInput<Scalar>& input, const Setpoint<Scalar>& setpoint, Telemetry<Scalar>& telemetry) {
  const Measurement<Scalar>& m = input.measured;
  if (config.drive.mode == Mode::off || config.drive.mode == Mode::duty) {
    state.drive.extras.slewing = Mode::off;
    state.command.enabled = false;
    return state.command;
  }
  state.measured = park(clarke(Abc<Scalar>{m.i_a_A, m.i_b_A, m.i_c_A}), input.magnet.sampled);
  const detail::FieldAsked<Scalar> asked =
      detail::field_asked(config, state, m, input.magnet.angle, setpoint, telemetry);
  if (config.finite_set.on) return detail::choose_legs(config, state, input);
  const Dq<Scalar>& v = detail::field_voltage(config, state, m, input.magnet.angle, asked);
  state.command = space_vector(inverse_clarke(inverse_park(v, input.magnet.answered)), m.bus_V);
  return state.command;
}

/// Replaces the configuration between two ticks (retune.hpp). Loops that the old mode did not use start with
/// zero state.
template <class Scalar>
constexpr void retune(FieldDriveConfig<Scalar>& config, FieldDriveState<Scalar>& state,
                      const FieldDriveConfig<Scalar>& next) {
  if (next.drive.mode != config.drive.mode) {
    detail::rest_idle_loops(config.drive, state.drive);
    if (config.drive.mode == Mode::off || config.drive.mode == Mode::duty) {
      state.current = {};
      state.weakening = {};
      state.finite_set = {};
      state.reference = {};
    }
  }
  detail::hand_speed_over(config.drive, state.drive, next.drive);
  detail::hand_profile_over(config.drive, state.drive, next.drive);
  config = next;
}

}  // namespace sixstep::control
