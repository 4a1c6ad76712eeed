// SPDX-License-Identifier: Apache-2.0
// Firmware of a field-oriented drive (control/field/). The table's columns are as in firmware.hpp:
//
//                input of a tick                              a Hall edge    a fault         reports
//   FieldDrive   ideal values, or those of [sensors], and     captured       ends the run    lost sensor
//                the magnet's direction
//
// Its command is always for three legs. With an ideal sensor the drive receives the exact cosine and sine of
// the magnet's direction. With an encoder, a resolver or Hall edges the drive computes both from the decoded
// angle, as on the chip (field_direction.hpp).
#pragma once
#include "sixstep/control/field/sensorless_field_drive.hpp"
#include "sixstep/rig/field_telemetry.hpp"
#include "sixstep/rig/firmware.hpp"
#include "sixstep/rig/magnet_angle.hpp"

namespace sixstep::rig {

template <class Scalar>
class FieldDrive {
 public:
  using Number = Scalar;
  using Command = control::LegCommands<Scalar>;
  using Config = control::SensorlessFieldConfig<Scalar>;
  static constexpr bool fault_ends_run = true;

  FieldDrive(const Config& config, const BoardConfig& board, const PowerUp& power_up)
      : config_(config),
        sensors_(board.sensors, board.bases, power_up),
        bases_(board.bases),
        ideal_(board.sensors.ideal()),
        core_(board.core) {}

  template <class Real>
  const Command& tick(const SampleInstant<Real>& instant, double setpoint) {
    control::FieldDriveInput<Scalar> input{.measured = ideal_measurement<Scalar>(instant, bases_),
                                           .magnet = {}};
    if (!ideal_) sensors_.sense(input.measured, sample_of(instant));
    input.magnet = sensors_.tells_angle()
                       ? control::field_directions(config_.field.advance, sensors_.electrical_angle(),
                                                   input.measured.speed_rad_s)
                       : directions_as_they_are(instant.state);
    const control::Setpoint<Scalar> wanted{from_si<Scalar>(setpoint, bases_.setpoint)};
    control::sensorless_field_step(config_, state_, input, wanted, telemetry_);
    if (core_.there()) hold_against_core(input, wanted, instant.at);
    angle_error_deg_ = error_deg(instant.state);
    if (sensors_.shaft_found().lost()) {
      state_.field.command = control::detail::given_up_legs<Scalar>();
    }
    return state_.field.command;
  }
  void captured(std::uint8_t pins, const sim::Instant& at) { sensors_.hall_edge(pins, at); }
  void request_run(bool) {}
  void request_clear() {}
  void retune(const Tuning<Config>& tuning) {
    control::retune(config_, state_, tuning.config);
    bases_.setpoint = tuning.setpoint_unit;
  }

  control::Mode mode() const { return config_.field.drive.mode; }
  /// True if a tick needs only the setpoint and no measurement.
  bool open_loop() const { return config_.field.drive.mode == control::Mode::off; }
  bool follows_setpoint_at_once() const { return false; }
  const control::Telemetry<Scalar>& telemetry() const { return telemetry_; }
  Diagnosis diagnosis() const {
    Diagnosis found{.hall_line = sensors_.broken_line(),
                    .at = core_.at(),
                    .shaft = sensors_.shaft_found(),
                    .core = core_.trouble(),
                    .shunt_samples = sensors_.low_side().samples,
                    .blind_samples = sensors_.low_side().blind};
    if (state_.estimator.phase != control::EstimatorPhase::unseen) return found;
    found.gave_up = true;
    if (state_.estimator.failures > 0) {
      found.losses = state_.estimator.failures;
      found.lost = control::LockLoss::start;
      return found;
    }
    found.unseen = 1;
    found.north = static_cast<double>(control::magnitude(control::north_seen(state_.estimator.north)));
    found.certain = static_cast<double>(config_.estimator.north.certain);
    return found;
  }
  /// Inputs of the firmware's converters and timers.
  Registers& registers() { return sensors_.registers(); }
  ShaftPorts& shaft_ports() { return sensors_.shaft_ports(); }
  const ShaftPorts& shaft_ports() const { return sensors_.shaft_ports(); }
  bool follows_shaft() const { return sensors_.follows_shaft(); }
  template <class Real>
  void follow(const ShaftMotion<Real>& motion) {
    sensors_.follow(motion);
  }
  /// State of the drive, with currents and voltages of the last tick in the rotor's frame.
  const control::FieldDriveState<Scalar>& state() const { return state_.field; }
  /// State of the estimator of the magnet's angle, for a drive without a rotor position sensor.
  const control::EstimatorState<Scalar>& estimator() const { return state_.estimator; }
  FieldTelemetry field_held() const {
    const auto si = [](const control::Dq<Scalar>& x, double unit) {
      return control::Dq<double>{to_si(x.d, unit), to_si(x.q, unit)};
    };
    return {si(state_.field.measured, bases_.current_A), si(state_.field.reference, bases_.current_A),
            si(state_.field.current.voltage, bases_.voltage_V), angle_error_deg_};
  }

 private:
  void hold_against_core(const control::FieldDriveInput<Scalar>& input,
                         const control::Setpoint<Scalar>& wanted, const sim::Instant& at) {
    FieldCall<Scalar> call{.measured = input.measured, .setpoint = wanted};
    if (sensors_.tells_angle()) {
      call.decoded = 1;
      call.electrical = sensors_.electrical_angle();
    } else {
      call.magnet = input.magnet;
    }
    state_.field.command = core_.held(call, state_.field.command, at);
  }
  /// Assumed angle at the last tick minus the true angle, electrical degrees; 0 for an ideal sensor.
  template <class Real>
  double error_deg(const plant::State<Real>& s) const {
    if (!config_.estimator.on && !sensors_.tells_angle()) return 0.0;
    const control::BinaryAngle taken =
        config_.estimator.on ? state_.estimator.sampled : control::magnet_angle(sensors_.electrical_angle());
    constexpr double deg = 360.0 / 4294967296.0;
    return deg * static_cast<double>(control::way_between(binary_angle(magnet_rad(s)), taken));
  }
  template <class Real>
  control::FieldDirections<Scalar> directions_as_they_are(const plant::State<Real>& s) const {
    const double magnet = magnet_rad(s);
    const double on = static_cast<double>(config_.field.advance.rad_s) * static_cast<double>(s.w);
    return {direction_at<Scalar>(magnet), direction_at<Scalar>(magnet + on), binary_angle(magnet)};
  }

  Config config_;
  Sensors<Scalar> sensors_;
  Bases bases_;
  bool ideal_;
  control::SensorlessFieldState<Scalar> state_{};
  control::Telemetry<Scalar> telemetry_{};
  double angle_error_deg_ = 0.0;
  LockstepCore core_;
};

}  // namespace sixstep::rig
