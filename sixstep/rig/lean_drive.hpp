// SPDX-License-Identifier: Apache-2.0
// Firmwares that consist only of the loops of control/drive.hpp. LeanDrive has ideal measurements,
// SensedDrive the measurements of a board's sensors.
#pragma once
#include "sixstep/control/retune.hpp"
#include "sixstep/rig/firmware.hpp"
#include "sixstep/rig/sensors.hpp"

namespace sixstep::rig {

/// Drive with ideal measurements.
template <class Scalar>
class LeanDrive {
 public:
  using Number = Scalar;
  using Command = control::BridgeCommand<Scalar>;
  using Config = control::DriveConfig<Scalar>;
  static constexpr bool fault_ends_run = true;

  LeanDrive(const Config& config, const BoardConfig& board, const PowerUp&)
      : config_(config), bases_(board.bases) {}

  template <class Real>
  const control::BridgeCommand<Scalar>& tick(const SampleInstant<Real>& instant, double setpoint) {
    return step(ideal_measurement<Scalar>(instant, bases_), setpoint);
  }
  /// Returns a reference to the stored command. A copy would stall the processor until the fields that were
  /// just written are in memory.
  const control::BridgeCommand<Scalar>& step(const control::Measurement<Scalar>& measured, double setpoint) {
    control::step(config_, state_, measured, wanted(setpoint), telemetry_);
    return state_.command;
  }
  control::Setpoint<Scalar> wanted(double setpoint) const {
    return {from_si<Scalar>(setpoint, bases_.setpoint)};
  }
  void captured(std::uint8_t, const sim::Instant&) {}
  control::BridgeCommand<Scalar> hall_interrupt(std::uint8_t pins, const sim::Instant&) {
    return control::on_hall(config_, state_, pins);
  }
  void request_run(bool) {}
  void request_clear() {}
  void retune(const Tuning<Config>& tuning) {
    control::retune(config_, state_, tuning.config);
    bases_.setpoint = tuning.setpoint_unit;
  }

  control::Mode mode() const { return config_.mode; }
  /// Sign of the last command.
  bool reversed() const { return state_.reversed; }
  /// True if a tick needs only the setpoint and no measurement.
  bool open_loop() const { return config_.mode == control::Mode::off || config_.mode == control::Mode::duty; }
  /// True for an event hysteresis whose reference is the setpoint, without waiting for a sample (model.md 4).
  /// With a slew rate the result is false, because the reference changes once per tick.
  bool follows_setpoint_at_once() const {
    return config_.mode == control::Mode::current &&
           config_.current_control == control::CurrentControl::hysteresis &&
           config_.hysteresis.watch != control::Watch::none &&
           // mutant: !(config_.extras.on && config_.extras.slews_setpoint) => true
           !(config_.extras.on && config_.extras.slews_setpoint);
  }
  /// True while the command contains the duty of a commutation (control/commutation_step.hpp).
  bool holds_commutation() const { return control::detail::holds_current(config_, state_); }
  const control::Telemetry<Scalar>& telemetry() const { return telemetry_; }
  Diagnosis diagnosis() const { return {}; }

 private:
  Config config_;
  Bases bases_;
  control::DriveState<Scalar> state_{};
  control::Telemetry<Scalar> telemetry_{};
};

/// Drive with the measurements of a board's sensors.
template <class Scalar>
class SensedDrive {
 public:
  using Number = Scalar;
  using Command = control::BridgeCommand<Scalar>;
  using Config = control::DriveConfig<Scalar>;
  static constexpr bool fault_ends_run = true;

  SensedDrive(const Config& config, const BoardConfig& board, const PowerUp& power_up)
      : drive_(config, board, power_up),
        sensors_(board.sensors, board.bases, power_up),
        bases_(board.bases),
        core_(board.core) {}

  template <class Real>
  control::BridgeCommand<Scalar> tick(const SampleInstant<Real>& instant, double setpoint) {
    control::Measurement<Scalar> measured = ideal_measurement<Scalar>(instant, bases_);
    sensors_.sense(measured, sample_of(instant));
    control::BridgeCommand<Scalar> answer = drive_.step(measured, setpoint);
    if (core_.there())
      answer = core_.held(LeanCall<Scalar>{.measured = measured, .setpoint = drive_.wanted(setpoint)}, answer,
                          instant.at);
    if (sensors_.shaft_found().lost()) answer = {.fault = true};
    return answer;
  }
  void captured(std::uint8_t pins, const sim::Instant& at) { sensors_.hall_edge(pins, at); }
  control::BridgeCommand<Scalar> hall_interrupt(std::uint8_t pins, const sim::Instant& at) {
    control::BridgeCommand<Scalar> answer = drive_.hall_interrupt(pins, at);
    if (core_.there())
      answer = core_.held(LeanCall<Scalar>{.entry = CoreEntry::hall, .pins = pins}, answer, at);
    if (answer.enabled) sensors_.commutated();
    return answer;
  }
  void request_run(bool) {}
  void request_clear() {}
  void retune(const Tuning<Config>& tuning) { drive_.retune(tuning); }

  control::Mode mode() const { return drive_.mode(); }
  bool reversed() const { return drive_.reversed(); }
  bool open_loop() const { return drive_.open_loop(); }
  bool follows_setpoint_at_once() const { return drive_.follows_setpoint_at_once(); }
  bool holds_commutation() const { return drive_.holds_commutation(); }
  const control::Telemetry<Scalar>& telemetry() const { return drive_.telemetry(); }
  Diagnosis diagnosis() const {
    return {.hall_line = sensors_.broken_line(),
            .at = core_.at(),
            .shaft = sensors_.shaft_found(),
            .core = core_.trouble(),
            .shunt_samples = sensors_.low_side().samples,
            .blind_samples = sensors_.low_side().blind};
  }
  /// Inputs of the firmware's converters and timers.
  Registers& registers() { return sensors_.registers(); }
  ShaftPorts& shaft_ports() { return sensors_.shaft_ports(); }
  const ShaftPorts& shaft_ports() const { return sensors_.shaft_ports(); }
  const Sensors<Scalar>& sensors() const { return sensors_; }
  /// True if the board has an encoder or a resolver. Their values change between samples: a timer counts, or
  /// a code is latched.
  bool follows_shaft() const { return sensors_.follows_shaft(); }
  template <class Real>
  void follow(const ShaftMotion<Real>& motion) {
    sensors_.follow(motion);
  }

 private:
  LeanDrive<Scalar> drive_;
  Sensors<Scalar> sensors_;
  Bases bases_;
  LockstepCore core_;
};

}  // namespace sixstep::rig
