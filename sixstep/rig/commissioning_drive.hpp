// SPDX-License-Identifier: Apache-2.0
// Firmware that identifies motor and wiring (control/commissioning/). Afterwards it drives the motor in
// six-step operation with the identified table, at the setpoint's duty:
//
//                        input of a tick                       a Hall edge         a fault
//   CommissioningDrive   counts of currents and bus, pins      captured, noted     bridge off
//
// Its command is always for three legs, because the pair changes at the tick after an edge, not at the edge.
#pragma once
#include "sixstep/control/commissioning/commissioning_result.hpp"
#include "sixstep/rig/firmware.hpp"

namespace sixstep::rig {

template <class Scalar>
class CommissioningDrive {
 public:
  using Number = Scalar;
  using Command = control::LegCommands<Scalar>;
  using Config = control::CommissioningConfig;
  static constexpr bool fault_ends_run = false;
  static constexpr bool decodes_arrangement = true;  ///< the board does not convert the code of the pins

  CommissioningDrive(const Config& config, const BoardConfig& board, const PowerUp&)
      : config_(config), registers_(board.sensors) {}

  template <class Real>
  const Command& tick(const SampleInstant<Real>& instant, double setpoint) {
    if (state_.phase == control::CommissioningPhase::done)
      return command_ = driven(instant.pins, from_si<Scalar>(setpoint, 1.0));
    const Sample sample = sample_of(instant);
    control::CommissioningInput input{.bus_counts = registers_.bus_counts(sample),
                                      .at = registers_.counter(instant.at),
                                      .pins = instant.pins};
    for (std::size_t k = 0; k < 3; ++k)
      input.current_counts[k] = registers_.current_counts(k, sample.i_A[k], sample.number);
    return command_ = control::commissioning_step<Scalar>(config_, state_, input);
  }
  void captured(std::uint8_t pins, const sim::Instant& at) {
    control::commissioning_hall(config_, state_, pins, registers_.counter(at));
  }
  void request_run(bool) {}
  void request_clear() {}
  void retune(const Tuning<Config>& tuning) { config_ = tuning.config; }
  bool open_loop() const { return false; }
  bool follows_setpoint_at_once() const { return false; }
  Diagnosis diagnosis() const { return {}; }
  Registers& registers() { return registers_; }
  /// State of commissioning, with the results so far.
  const control::CommissioningState& found() const { return state_; }

 private:
  /// Six-step command from the table, in the direction of the duty's sign.
  Command driven(std::uint8_t pins, Scalar duty) const {
    const std::uint8_t sector = state_.probes.lines.sector[pins & 7U];
    if (sector == control::no_sector) return Command{};
    const control::Pair pair = control::positive_pair(sector);
    const bool backward = duty < Scalar{};
    return control::as_legs(control::BridgeCommand<Scalar>{.enabled = true,
                                                           .pair = backward ? control::swapped(pair) : pair,
                                                           .duty = backward ? -duty : duty,
                                                           .chopping = control::Chopping::complementary});
  }

  Config config_;
  Registers registers_;
  control::CommissioningState state_{};
  Command command_{};
};

}  // namespace sixstep::rig
