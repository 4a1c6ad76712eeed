// SPDX-License-Identifier: Apache-2.0
// The field-oriented drive without a sensor on its rotor: field_drive.hpp, told by magnet_estimator.hpp where the magnet points
// and how fast it turns. Until that is known it asks for the estimator's own current, and neither setpoint nor speed
// loop has a say. Without an estimator it is field_drive.hpp's drive; with one it makes pulses, and chooses no states of legs. Where the estimator sees no north, or the rotor does not
// follow the current that turns it, it gives up: fault.
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

/// By themselves: GCC 12 ends with an internal error where a member is set to a temporary that begins with defaults.
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

/// The loops are at rest where the frame is a new one.
template <class Scalar>
constexpr void field_anew(FieldDriveState<Scalar>& state) {
  state.current = {};
  state.weakening = {};
  state.reference = {};
}

/// The bus whose circle leaves room for the pulse: one that is cut off tells nothing.
template <class Scalar>
constexpr Scalar bus_beside(const InjectionConfig<Scalar>& config, Scalar bus_V) {
  constexpr auto root_3 = static_cast<Gain<Scalar>>(1.7320508075688772);
  const Scalar left = bus_V - ScalarTraits<Scalar>::product(config.voltage_V, root_3);
  return left > Scalar{} ? left : Scalar{};
}

/// What pulls the rotor to the axis is a voltage: it damps the swing, which a current that is held would not do. The loop that holds
/// the current once the axis turns goes on from it.
template <class Scalar>
constexpr const Dq<Scalar>& aligning_voltage(const SensorlessFieldConfig<Scalar>& config,
                                             FieldCurrentState<Scalar>& state) {
  using T = ScalarTraits<Scalar>;
  state.voltage = {T::product(config.estimator.start.current_A, config.estimator.flux.R_ohm), Scalar{}};
  state.d.u = T::accumulator(state.voltage.d);
  return state.voltage;
}

/// The voltage for what the estimator itself asks for.
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

/// Whether what is asked for turns a rotor fast enough to be seen by its flux.
template <class Scalar>
constexpr bool asks_to_turn(const SensorlessFieldConfig<Scalar>& config, Scalar setpoint) {
  const Scalar least = config.field.drive.mode == Mode::speed ? config.estimator.low_rad_s : Scalar{};
  return magnitude(setpoint) > least;
}

}  // namespace detail

/// One control tick. The answer lies in state.field.command, up to the next call.
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

/// Another configuration between two ticks. What was found of the magnet stays.
template <class Scalar>
constexpr void retune(SensorlessFieldConfig<Scalar>& config, SensorlessFieldState<Scalar>& state,
                      const SensorlessFieldConfig<Scalar>& next) {
  retune(config.field, state.field, next.field);
  config.estimator = next.estimator;
}

}  // namespace sixstep::control
