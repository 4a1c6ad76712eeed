// SPDX-License-Identifier: Apache-2.0
// Runs the field-oriented drive (field_drive.hpp) without a rotor position sensor: magnet_estimator.hpp
// estimates the magnet's direction and speed. Until it follows the rotor, the estimator determines the
// current, and setpoint and speed loop have no effect. With the estimator off, this drive equals the drive of
// field_drive.hpp. With the estimator on, the space-vector modulator is always used, never finite_set.hpp.
// The drive stops with a fault if the estimator does not find north, or if the rotor does not follow the
// start's current vector.
#pragma once
#include "sixstep/control/field/field_drive.hpp"
#include "sixstep/control/field/magnet_estimator.hpp"

namespace sixstep::control {

template <class Scalar>
struct SensorlessFieldConfig {
  FieldDriveConfig<Scalar> field{};
  EstimatorConfig<Scalar> estimator{};
  bool operator==(const SensorlessFieldConfig&) const = default;
};

template <class Scalar>
struct SensorlessFieldState {
  FieldDriveState<Scalar> field{};
  EstimatorState<Scalar> estimator{};
};

namespace detail {

/// These are separate functions because GCC 12 stops with an internal error if a member is assigned a
/// temporary with default members.
template <class Scalar>
constexpr LegCommands<Scalar> given_up_legs() {
  LegCommands<Scalar> command{};
  command.fault = true;
  return command;
}
template <class Scalar>
constexpr EstimatorState<Scalar> unbegun() {
  return {};
}

/// Resets the current loops, because the rotor's frame has changed.
template <class Scalar>
constexpr void field_anew(FieldDriveState<Scalar>& state) {
  state.current = {};
  state.weakening = {};
  state.reference = {};
}

/// Bus voltage, V, minus the part that the pulse needs. The loops' voltage is limited to the rest, because a
/// clipped pulse would falsify the estimate.
template <class Scalar>
constexpr Scalar bus_beside(const InjectionConfig<Scalar>& config, Scalar bus_V) {
  constexpr auto root_3 = static_cast<Gain<Scalar>>(1.7320508075688772);
  const Scalar left = bus_V - ScalarTraits<Scalar>::product(config.voltage_V, root_3);
  return left > Scalar{} ? left : Scalar{};
}

/// Voltage that pulls the rotor to the axis. A constant voltage damps the rotor's oscillation; a controlled
/// current would not. When the axis begins to turn, the current loop continues from this voltage.
template <class Scalar>
constexpr const Dq<Scalar>& aligning_voltage(const SensorlessFieldConfig<Scalar>& config,
                                             FieldCurrentState<Scalar>& state) {
  using T = ScalarTraits<Scalar>;
  state.voltage = {T::product(config.estimator.start.current_A, config.estimator.flux.R_ohm), Scalar{}};
  state.d.u = T::accumulator(state.voltage.d);
  return state.voltage;
}

/// Voltage in the phases in which the estimator determines the current reference.
template <class Scalar>
constexpr Dq<Scalar> estimating_voltage(const SensorlessFieldConfig<Scalar>& config,
                                        SensorlessFieldState<Scalar>& state,
                                        const Measurement<Scalar>& measured, Telemetry<Scalar>& telemetry) {
  FieldDriveState<Scalar>& field = state.field;
  field.reference = {estimator_reference_d(config.estimator, state.estimator), Scalar{}};
  telemetry.motor_current_A = field.measured.q;
  telemetry.current_reference_A = Scalar{};
  if (state.estimator.phase == EstimatorPhase::aligning) return aligning_voltage(config, field.current);
  return field_current_step(config.field.current, field.current, field.reference, field.measured,
                            measured.speed_rad_s, measured.bus_V);
}

}  // namespace detail

namespace detail {

/// True if the setpoint requires a speed at which the flux can be followed.
template <class Scalar>
constexpr bool asks_to_turn(const SensorlessFieldConfig<Scalar>& config, Scalar setpoint) {
  const Scalar least = config.field.drive.mode == Mode::speed ? config.estimator.low_rad_s : Scalar{};
  return magnitude(setpoint) > least;
}

}  // namespace detail

/// One control tick. Returns state.field.command, valid until the next call.
template <class Scalar>
constexpr const LegCommands<Scalar>& sensorless_field_step(const SensorlessFieldConfig<Scalar>& config,
                                                           SensorlessFieldState<Scalar>& state,
                                                           const FieldDriveInput<Scalar>& input,
                                                           const Setpoint<Scalar>& setpoint,
                                                           Telemetry<Scalar>& telemetry) {
  const Mode mode = config.field.drive.mode;
  if (!config.estimator.on || mode == Mode::off || mode == Mode::duty) {
    if (state.estimator.begun) state.estimator = detail::unbegun<Scalar>();
    return field_drive_step(config.field, state.field, input, setpoint, telemetry);
  }
  EstimatorState<Scalar>& estimator = state.estimator;
  FieldDriveState<Scalar>& field = state.field;
  Measurement<Scalar> m = input.measured;
  const bool followed = estimator.phase == EstimatorPhase::following;
  field.measured = estimator_step(config.estimator, estimator, clarke(Abc<Scalar>{m.i_a_A, m.i_b_A, m.i_c_A}),
                                  setpoint.value < Scalar{}, detail::asks_to_turn(config, setpoint.value));
  if (estimator.phase == EstimatorPhase::unseen) {
    field.command = detail::given_up_legs<Scalar>();
    return field.command;
  }
  m.speed_rad_s = estimator.speed_rad_s;
  const bool injects = estimator_injects(config.estimator, estimator);
  if (injects) m.bus_V = detail::bus_beside(config.estimator.injection, m.bus_V);
  const bool follows = estimator.phase == EstimatorPhase::following;
  if (follows != followed) detail::field_anew(field);
  Dq<Scalar> v{};
  if (follows)
    v = detail::field_voltage(
        config.field, field, m, estimator.sampled,
        detail::field_asked(config.field, field, m, estimator.sampled, setpoint, telemetry));
  else
    v = detail::estimating_voltage(config, state, m, telemetry);
  const Direction<Scalar> answered =
      magnet_directions(config.field.advance, estimator.sampled, m.speed_rad_s).answered;
  v.d += injected_voltage(config.estimator.injection, estimator.injection, answered, injects);
  field.command = space_vector(inverse_clarke(inverse_park(v, answered)), input.measured.bus_V);
  estimator_answered(estimator, field.command, input.measured.bus_V);
  return field.command;
}

/// Replaces the configuration between two ticks. The estimate of the magnet's direction is kept.
template <class Scalar>
constexpr void retune(SensorlessFieldConfig<Scalar>& config, SensorlessFieldState<Scalar>& state,
                      const SensorlessFieldConfig<Scalar>& next) {
  retune(config.field, state.field, next.field);
  config.estimator = next.estimator;
}

}  // namespace sixstep::control
