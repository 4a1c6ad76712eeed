// SPDX-License-Identifier: Apache-2.0
// Firmware that executes control/protected_drive.hpp, with registers as on the chip.
#pragma once
#include "sixstep/control/protected_drive.hpp"
#include "sixstep/control/retune.hpp"
#include "sixstep/rig/firmware.hpp"
#include "sixstep/rig/registers.hpp"

namespace sixstep::rig {

/// The program of a product. Its input are registers, its output is a command. The scenario's timeline sets
/// the request to run.
template <class Scalar>
class ProductDrive {
 public:
  using Number = Scalar;
  using Command = control::BridgeCommand<Scalar>;
  using Config = control::ProtectedConfig<Scalar>;
  static constexpr bool fault_ends_run = false;
  static constexpr bool decodes_arrangement = true;  ///< the configuration contains the arrangement of the
                                                     ///< probes

  /// The counted position starts at the rotor's sector at power-up.
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
  /// Requests to clear a fault. The request is reset after the next tick, because clearing needs a rising
  /// edge.
  void request_clear() { request_.clear = true; }
  void retune(const Tuning<Config>& tuning) {
    control::retune(config_, state_, tuning.config);
    bases_.setpoint = tuning.setpoint_unit;
  }

  control::Mode mode() const { return config_.drive.mode; }
  bool reversed() const { return state_.drive.reversed; }
  bool open_loop() const { return false; }
  bool follows_setpoint_at_once() const { return false; }
  bool holds_commutation() const { return control::detail::holds_current(config_.drive, state_.drive); }
  const control::Telemetry<Scalar>& telemetry() const { return telemetry_.drive; }
  control::Activity activity() const { return telemetry_.activity; }
  const Diagnosis& diagnosis() const { return diagnosis_; }
  /// True if the core has failed. This ends the run, because no controller can continue.
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
  LockstepCore core_;
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
  // The faulty line may be identified later than the fault, by the first invalid code while the rotor coasts.
  if ((diagnosis_.faults & control::fault_hall) != 0) diagnosis_.hall_line = telemetry_.hall_line;
  return answer;
}

}  // namespace sixstep::rig
