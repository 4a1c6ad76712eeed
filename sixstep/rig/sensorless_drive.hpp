// SPDX-License-Identifier: Apache-2.0
// Firmware of a drive without a rotor position sensor (control/sensorless/). In contrast to the drives of
// firmware.hpp it samples the three terminals, and requests timer interrupts between two ticks.
//
//                     input of a tick                         a compare match         a fault
//   SensorlessDrive   terminals and bus as counts, currents   sensorless_drive_       bridge off, new start; off after
//                     as SensedDrive                          commutate               more than lock.retries losses
//                                                                                     in sequence
//
// The same timer captures the edges of comparators at the terminals (crossing_comparators.hpp). Terminals and
// bus have equal dividers and converters, `sensors.bus`. The frequency of the timer is `sensors.capture_Hz`.
// If pulses determine the rotor's angle at the start (control/commissioning/pulse_start.hpp), the drive also
// reads the counts of the currents.
#pragma once
#include "sixstep/control/commissioning/pulse_start.hpp"
#include "sixstep/rig/firmware.hpp"
#include "sixstep/rig/lockstep_core.hpp"
#include "sixstep/rig/sensorless_call.hpp"

namespace sixstep::rig {

template <class Scalar>
class SensorlessDrive {
 public:
  using Number = Scalar;
  using Command = control::BridgeCommand<Scalar>;
  using Config = control::PulsedDriveConfig<Scalar>;
  static constexpr bool fault_ends_run = false;
  /// Least duty at which the pair counts as on at the sample, so that the terminals are compared with the
  /// command.
  static constexpr double surely_on = 0.05;

  SensorlessDrive(const Config& config, const BoardConfig& board, const PowerUp& power_up)
      : config_(config),
        sensors_(board.sensors, board.bases, power_up),
        bases_(board.bases),
        capture_Hz_(board.sensors.capture_Hz),
        period_s_(static_cast<double>(board.modulator.period_ticks) / sim::ticks_per_second),
        core_(board.core) {
    for (std::size_t k = 0; k < 3; ++k) gain_[k] = 1.0 + board.front_end.divider_gain_error[k];
  }

  /// Sets the terminal voltages of the next sample, V.
  template <class Real>
  void look_at_terminals(const plant::PerLeg<Real>& u) {
    for (std::size_t k = 0; k < 3; ++k) terminal_V_[k] = gain_[k] * static_cast<double>(u[k]);
  }
  /// Breaks the upper resistor of a leg's divider. The converter's input is 0 from now on, due to the lower
  /// resistor.
  void break_divider(std::size_t leg) { gain_[leg] = 0.0; }

  template <class Real>
  const Command& tick(const SampleInstant<Real>& instant, double setpoint) {
    const Sample sample = sample_of(instant);
    control::PulsedDriveInput<Scalar> input{};
    control::SensorlessDriveInput<Scalar>& seen = input.drive;
    seen.measured = ideal_measurement<Scalar>(instant, bases_);
    seen.hall_pins = instant.pins;
    seen.measured.hall = control::hall_of_sector(rotor().sector);
    sensors_.sense(seen.measured, sample);
    Registers& registers = sensors_.registers();
    for (std::size_t k = 0; k < 3; ++k)
      seen.terminals.u[k] = registers.terminal_counts(k, terminal_V_[k], sample.number);
    if (config_.pulses.pulse_ticks > 0)
      for (std::size_t k = 0; k < 3; ++k)
        input.current_counts[k] = registers.current_counts(k, sample.i_A[k], sample.number);
    seen.terminals.bus = registers.bus_counts(sample);
    seen.terminals.at = registers.counter(instant.at);
    seen.on = config_.drive.sensorless.crossing.seen == control::NeutralSeen::on_time && command().enabled &&
              instant.duty > surely_on;
    if (config_.drive.sensorless.captured.period_ticks > 0)
      seen.on_ticks = static_cast<std::uint32_t>(instant.duty * period_s_ * capture_Hz_);
    const bool asks = state_.pulsing;
    const std::uint8_t before = rotor().sector;
    const control::Setpoint<Scalar> wanted{from_si<Scalar>(setpoint, bases_.setpoint)};
    control::pulsed_drive_step(config_, state_, input, wanted, telemetry_);
    if (core_.there()) hold_against_core(call_of(input, wanted), instant.at);
    moved_on_ = rotor().sector != before;
    if (asks && !state_.pulsing && !state_.found.seen) ++unseen_;
    note_losses(instant.at);
    find_next(instant.at);
    return command();
  }
  /// Captures an edge of the comparators at the terminals; `lines`: lines of legs a, b, c as bits 2, 1, 0.
  void captured_crossing(std::uint8_t lines, const sim::Instant& at) {
    const std::uint32_t now = sensors_.registers().counter(at);
    control::sensorless_capture(state_.drive.sensorless, lines, now);
    if (core_.there()) hold_against_core({.entry = CoreEntry::capture, .now = now, .pins = lines}, at);
  }
  void captured(std::uint8_t pins, const sim::Instant& at) { sensors_.hall_edge(pins, at); }
  const Command& hall_interrupt(std::uint8_t pins, const sim::Instant& at) {
    const std::uint32_t now = sensors_.registers().counter(at);
    if (control::sensorless_drive_hall(config_.drive, state_.drive, pins, now)) sensors_.commutated();
    if (core_.there()) hold_against_core({.entry = CoreEntry::hall, .now = now, .pins = pins}, at);
    find_next(at);
    return command();
  }
  /// True if the last tick found a commutation that was already due.
  bool moved_on() const { return moved_on_; }
  /// Instant of the timer's compare match.
  const sim::Instant& next_commutation() const { return next_; }
  const Command& commutation_interrupt(const sim::Instant& at) {
    const std::uint32_t now = rotor().clock.next;
    control::sensorless_drive_commutate(config_.drive, state_.drive, now);
    if (core_.there()) hold_against_core({.entry = CoreEntry::commutate, .now = now}, at);
    sensors_.commutated();
    find_next(at);
    return command();
  }
  void request_run(bool) {}
  void request_clear() {}
  void retune(const Tuning<Config>& tuning) {
    config_.pulses = tuning.config.pulses;
    control::retune(config_.drive, state_.drive, tuning.config.drive);
    bases_.setpoint = tuning.setpoint_unit;
  }

  control::Mode mode() const { return config_.drive.drive.mode; }
  bool reversed() const { return state_.drive.drive.reversed; }
  bool open_loop() const { return false; }
  bool follows_setpoint_at_once() const { return false; }
  const control::Telemetry<Scalar>& telemetry() const { return telemetry_; }
  Diagnosis diagnosis() const {
    if (core_lost()) return {.at = core_.at(), .core = core_.trouble()};
    return {.hall_line = source().line,
            .at = lost_at_,
            .losses = losses_,
            .lost = rotor().lock.last,
            .gave_up = rotor().phase == control::SensorlessPhase::gave_up,
            .unseen = unseen_,
            .north = state_.found.north_16 / 16.0,
            .certain = static_cast<double>(config_.pulses.certain),
            .shunt_samples = sensors_.low_side().samples,
            .blind_samples = sensors_.low_side().blind};
  }
  /// True if the core has failed. This ends the run, because no controller can continue.
  bool core_lost() const { return core_.trouble() != CoreTrouble::none; }
  Registers& registers() { return sensors_.registers(); }
  /// rotor(): state of the sensorless position. source(): present source of commutation.
  const control::SensorlessState& rotor() const { return state_.drive.sensorless; }
  const control::PositionSourceState& source() const { return state_.drive.source; }
  /// State of the pulses at the start, with their results.
  const control::PulsedDriveState<Scalar>& start() const { return state_; }

 private:
  const Command& command() const { return state_.drive.drive.command; }
  void hold_against_core(const SensorlessCall<Scalar>& call, const sim::Instant& at) {
    if (core_.agrees(call, answer_of(state_), at)) return;
    control::BridgeCommand<Scalar> off{};
    off.fault = true;
    state_.drive.drive.command = off;
  }
  /// Counts all losses, because lock.losses counts only consecutive losses and is reset to 0.
  void note_losses(const sim::Instant& now) {
    const int in_a_row = rotor().lock.losses;
    if (in_a_row > in_a_row_) {
      ++losses_;
      lost_at_ = now;
    }
    in_a_row_ = in_a_row;
  }
  void find_next(const sim::Instant& now) {
    std::uint32_t at = 0;
    next_ = sim::Instant::never();
    if (!control::next_commutation(state_.drive, at)) return;
    const std::uint32_t counts = at - sensors_.registers().counter(now);
    if (counts >= 0x80000000u)
      next_ = now;
    else
      next_ = now.plus_ticks(static_cast<double>(counts) * (sim::ticks_per_second / capture_Hz_));
  }

  Config config_;
  Sensors<Scalar> sensors_;
  Bases bases_;
  double capture_Hz_, period_s_;
  double terminal_V_[3]{}, gain_[3]{};
  bool moved_on_ = false;
  sim::Instant next_ = sim::Instant::never(), lost_at_{};
  int losses_ = 0, in_a_row_ = 0, unseen_ = 0;
  control::PulsedDriveState<Scalar> state_{};
  control::Telemetry<Scalar> telemetry_{};
  LockstepCore core_;
};

}  // namespace sixstep::rig
