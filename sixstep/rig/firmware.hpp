// SPDX-License-Identifier: Apache-2.0
// Three firmwares for the virtual board, as a template parameter of the rig: what differs between them stands
// here, and a run pays for its own one only.
//
//                 a tick is given                    a Hall edge           a fault              it tells
//   LeanDrive     what is, in the controller's unit  on_hall               ends the run         -
//   SensedDrive   the same through [sensors]         captured, on_hall     ends the run         broken line,
//                                                                                               lost sensor
//   ProductDrive  registers: counts, pins, counter   protected_on_hall     bridge off, goes on  reason, line,
//                                                                                               when
//
// LeanDrive and SensedDrive run drive.hpp; ProductDrive runs protected_drive.hpp, offset calibration, Hall
// decoding, fault monitor and state machine included.
//
// What a firmware answers, its Command, chooses the modulator (modulator.hpp). One that answers three legs
// needs neither hall_interrupt() nor reversed(): both are six-step's.
#pragma once
#include "sixstep/base/angle.hpp"
#include "sixstep/control/retune.hpp"
#include "sixstep/control/sensorless/lock.hpp"
#include "sixstep/plant/plant.hpp"
#include "sixstep/rig/board_config.hpp"
#include "sixstep/rig/own_answer.hpp"
#include "sixstep/rig/sensors.hpp"

namespace sixstep::rig {

/// The instant that a firmware's tick looks at.
template <class Real>
struct SampleInstant {
  const plant::State<Real>& state;
  const plant::Legs& legs;
  Real pole_pairs{};
  sim::Instant at{};
  std::uint64_t number = 0;  ///< of the sample
  std::uint8_t pins = 0;
  bool reversed = false;  ///< sign of the six-step command in effect
  double duty = 0.0;      ///< and its duty: what a shunt in the DC link goes by
  const FrontEndReading* seen =
      nullptr;  ///< what the converters' inputs stand at, where the board's front end lags
};

/// What a firmware has found out about a fault.
struct Diagnosis {
  std::uint16_t faults = 0;    ///< bits of control::Fault that stopped the drive
  std::uint8_t hall_line = 0;  ///< 1..3: the line that made an impossible code; 0: none, or it cannot be told
  sim::Instant at{};           ///< the tick that latched them, or lost the rotor last
  int losses = 0;              ///< how often a sensorless drive lost the rotor, or did not get it turning
  control::LockLoss lost = control::LockLoss::none;  ///< why, the last time
  bool gave_up = false;                              ///< for good
  int unseen = 0;                                    ///< how often pulses did not show how the rotor stands
  double north = 0.0;                                ///< the last time, over its noise
  double certain = 0.0;                              ///< and what would have been enough
  ShaftFinding shaft{};                              ///< of an encoder or a resolver that is lost
  OwnWrong own = OwnWrong::none;                     ///< what a controller of one's own answered
  CoreTrouble core = CoreTrouble::none;              ///< of a core beside the host
};

/// What a chip is given while it runs (control/retune.hpp).
template <class Config>
struct Tuning {
  Config config;
  double setpoint_unit = 1.0;  ///< that of its mode
};

/// Everything as it is.
template <class Scalar, class Real>
control::Measurement<Scalar> ideal_measurement(const SampleInstant<Real>& instant, const Bases& u) {
  const plant::State<Real>& s = instant.state;
  // mutant: s.x * Real(180) / Real(base::pi) => s.x
  const Real sector_deg = static_cast<Real>(s.sector) * 60 + s.x * Real(180) / Real(base::pi);
  return {.i_a_A = from_si<Scalar>(s.i[0], u.current_A),
          .i_b_A = from_si<Scalar>(s.i[1], u.current_A),
          .i_c_A = from_si<Scalar>(s.i[2], u.current_A),
          .speed_rad_s = from_si<Scalar>(s.w, u.speed_rad_s),
          .position_deg = from_si<Scalar>(sector_deg / instant.pole_pairs, u.position_deg),
          .bus_V = from_si<Scalar>(s.bus, u.voltage_V),
          .hall = instant.pins};
}

/// What converters and shunt are exposed to.
template <class Real>
Sample sample_of(const SampleInstant<Real>& instant) {
  const plant::State<Real>& s = instant.state;
  Sample sample{.bus_V = static_cast<double>(s.bus),
                .at = instant.at,
                .number = instant.number,
                .duty = instant.duty,
                .reversed = instant.reversed,
                .shaft = {s.sector, static_cast<double>(s.x), static_cast<std::int64_t>(instant.pole_pairs)}};
  for (std::size_t k = 0; k < 3; ++k) {
    sample.i_A[k] = static_cast<double>(s.i[k]);
    if (plant::is_high(instant.legs[k])) sample.dc_link_A += sample.i_A[k];
  }
  if (instant.seen == nullptr) return sample;
  if (instant.seen->currents) {
    for (std::size_t k = 0; k < 3; ++k) sample.i_A[k] = instant.seen->i_A[k];
    sample.dc_link_A = instant.seen->dc_link_A;
  }
  if (instant.seen->voltages) sample.bus_V = instant.seen->bus_V;
  return sample;
}

/// The loops alone, told what is.
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
  /// The command where it stands: a copy would have to wait for the fields that were just set.
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
  /// Asks nothing of a tick but the setpoint.
  bool open_loop() const { return config_.mode == control::Mode::off || config_.mode == control::Mode::duty; }
  /// An event hysteresis on the setpoint itself has no sample to wait for (model.md 4). One that slews has:
  /// it moves once a tick.
  bool follows_setpoint_at_once() const {
    return config_.mode == control::Mode::current &&
           config_.current_control == control::CurrentControl::hysteresis &&
           config_.hysteresis.watch != control::Watch::none &&
           // mutant: !(config_.extras.on && config_.extras.slews_setpoint) => true
           !(config_.extras.on && config_.extras.slews_setpoint);
  }
  const control::Telemetry<Scalar>& telemetry() const { return telemetry_; }
  Diagnosis diagnosis() const { return {}; }

 private:
  Config config_;
  Bases bases_;
  control::DriveState<Scalar> state_{};
  control::Telemetry<Scalar> telemetry_{};
};

/// The loops alone, told what a board's sensors say.
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
  const control::Telemetry<Scalar>& telemetry() const { return drive_.telemetry(); }
  Diagnosis diagnosis() const {
    return {.hall_line = sensors_.broken_line(),
            .at = core_.at(),
            .shaft = sensors_.shaft_found(),
            .core = core_.trouble()};
  }
  /// What its converters and timers are fed with.
  Registers& registers() { return sensors_.registers(); }
  ShaftPorts& shaft_ports() { return sensors_.shaft_ports(); }
  const ShaftPorts& shaft_ports() const { return sensors_.shaft_ports(); }
  const Sensors<Scalar>& sensors() const { return sensors_; }
  /// Whether an encoder's timer counts between samples, or a code is latched there.
  bool follows_shaft() const { return sensors_.follows_shaft(); }
  template <class Real>
  void follow(const ShaftMotion<Real>& motion) {
    sensors_.follow(motion);
  }

 private:
  LeanDrive<Scalar> drive_;
  Sensors<Scalar> sensors_;
  Bases bases_;
  BesideCore<Scalar> core_;
};

/// What is flashed: registers in, command out. The request to run is a level that the timeline sets.
template <class Scalar>
class ProductDrive {
 public:
  using Number = Scalar;
  using Command = control::BridgeCommand<Scalar>;
  using Config = control::ProtectedConfig<Scalar>;
  static constexpr bool fault_ends_run = false;
  static constexpr bool decodes_arrangement = true;  ///< its configuration names that of its probes

  /// It knows its turn: position counts on from where the rotor stands.
  ProductDrive(const Config& config, const BoardConfig& board, const PowerUp& power_up)
      : config_(config), registers_(board.sensors), bases_(board.bases), core_(board.core) {
    state_.position.sectors = static_cast<std::int32_t>(power_up.sector);
    if (core_.there())
      held({.entry = CoreEntry::start, .now = static_cast<std::uint32_t>(power_up.sector)}, {}, {});
  }

  template <class Real>
  control::BridgeCommand<Scalar> tick(const SampleInstant<Real>& instant, double setpoint);
  void captured(std::uint8_t, const sim::Instant&) {}
  control::BridgeCommand<Scalar> hall_interrupt(std::uint8_t pins, const sim::Instant& at) {
    const std::uint32_t now = registers_.counter(at);
    const control::BridgeCommand<Scalar> answer = control::protected_on_hall(config_, state_, pins, now);
    if (!core_.there()) return answer;
    return held(ProductCall<Scalar>{.entry = CoreEntry::hall, .now = now, .hall_pins = pins}, answer, at);
  }
  void request_run(bool run) { request_.run = run; }
  /// Seen by the next tick alone: clearing acts on the rise.
  void request_clear() { request_.clear = true; }
  void retune(const Tuning<Config>& tuning) {
    control::retune(config_, state_, tuning.config);
    bases_.setpoint = tuning.setpoint_unit;
  }

  control::Mode mode() const { return config_.drive.mode; }
  bool reversed() const { return state_.drive.reversed; }
  bool open_loop() const { return false; }
  bool follows_setpoint_at_once() const { return false; }
  const control::Telemetry<Scalar>& telemetry() const { return telemetry_.drive; }
  control::Activity activity() const { return telemetry_.activity; }
  const Diagnosis& diagnosis() const { return diagnosis_; }
  /// Where it ends, a fault ends the run: nothing is left to go on with.
  bool core_lost() const { return diagnosis_.core != CoreTrouble::none; }
  Registers& registers() { return registers_; }

 private:
  control::BridgeCommand<Scalar> held(const ProductCall<Scalar>& call,
                                      const control::BridgeCommand<Scalar>& answer, const sim::Instant& at) {
    const control::BridgeCommand<Scalar> out = core_.held(call, answer, at);
    if (core_.trouble() != CoreTrouble::none) diagnosis_ = {.at = core_.at(), .core = core_.trouble()};
    return out;
  }

  Config config_;
  Registers registers_;
  Bases bases_;
  control::Request request_{};
  control::ProtectedState<Scalar> state_{};
  control::ProtectedTelemetry<Scalar> telemetry_{};
  Diagnosis diagnosis_{};
  BesideCore<Scalar> core_;
};

template <class Scalar>
template <class Real>
control::BridgeCommand<Scalar> ProductDrive<Scalar>::tick(const SampleInstant<Real>& instant,
                                                          double setpoint) {
  const Sample s = sample_of(instant);
  const bool one_shunt = config_.sensing == control::CurrentSensing::one_shunt;
  control::BoardInput in{
      .bus_counts = registers_.bus_counts(s), .hall_pins = instant.pins, .now = registers_.counter(s.at)};
  for (std::size_t k = 0; k < (one_shunt ? 1u : 3u); ++k)
    in.current_counts[k] = registers_.current_counts(k, one_shunt ? s.dc_link_A : s.i_A[k], s.number);
  const control::Setpoint<Scalar> wanted{from_si<Scalar>(setpoint, bases_.setpoint)};
  control::BridgeCommand<Scalar> answer =
      control::protected_step(config_, state_, in, request_, wanted, telemetry_);
  if (core_.there()) answer = held(call_of(in, request_, wanted), answer, instant.at);
  request_.clear = false;
  if (telemetry_.first_fault != 0 && diagnosis_.faults == 0)
    diagnosis_ = {.faults = telemetry_.first_fault, .at = instant.at};
  // The line may be told later than the fault: by the first impossible code of the coasting rotor.
  if ((diagnosis_.faults & control::fault_hall) != 0) diagnosis_.hall_line = telemetry_.hall_line;
  return answer;
}

}  // namespace sixstep::rig
