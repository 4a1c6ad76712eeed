// SPDX-License-Identifier: Apache-2.0
// One interface for all firmwares. The rig is compiled once per kind of command (a pair, or three legs), and
// not for each firmware in each arithmetic. All values in calls are in SI units or register counts. The rig
// calls the firmware once per control period and once per interrupt.
//
//   Rig -> AnyDrive<Command> -> DriveInterface<Command> <- DriveOf<Firmware> (drive_of.hpp)
#pragma once
#include <memory>
#include <utility>

#include "sixstep/control/drive.hpp"
#include "sixstep/control/leg_command.hpp"
#include "sixstep/rig/field_telemetry.hpp"
#include "sixstep/rig/firmware.hpp"
#include "sixstep/rig/shaft_motion.hpp"

namespace sixstep::rig {

/// Result of a firmware's last tick or interrupt.
template <class Command>
struct DriveAnswer {
  Command command{};
  bool reversed = false;           ///< six-step, true: the command has a negative sign
  bool moved_on = false;           ///< true: the tick found a commutation that was already due
  bool holds_commutation = false;  ///< six-step, true: the command has the duty of a commutation
                                   ///< (control/commutation_step.hpp)
  sim::Instant next_commutation = sim::Instant::never();  ///< instant at which a compare match of the timer
                                                          ///< commutates
  control::Telemetry<double> told{};
  FieldTelemetry field{};  ///< values of a field-oriented drive; zeros for other drives
};

/// Properties of a firmware that change only when the firmware is retuned.
struct DriveTraits {
  control::Mode mode = control::Mode::off;
  bool open_loop = false;
  bool follows_setpoint_at_once = false;
  bool follows_shaft = false;
  bool wants_terminals = false;
  bool decodes_arrangement = false;
};

template <class Command>
class DriveConfig;

template <class Command>
class DriveInterface {
 public:
  using Answer = DriveAnswer<Command>;
  DriveInterface() = default;
  DriveInterface& operator=(const DriveInterface&) = delete;
  virtual ~DriveInterface() = default;

  virtual std::unique_ptr<DriveInterface> clone() const = 0;
  virtual DriveTraits traits() const = 0;
  virtual void tick(const SampleInstant<double>& instant, double setpoint, Answer& out) = 0;
  virtual void hall_interrupt(std::uint8_t pins, const sim::Instant& at, Answer& out) = 0;
  virtual void commutation_interrupt(const sim::Instant& at, Answer& out) = 0;
  virtual void captured(std::uint8_t pins, const sim::Instant& at) = 0;
  virtual void captured_crossing(std::uint8_t lines, const sim::Instant& at) = 0;
  virtual void look_at_terminals(const plant::PerLeg<double>& terminal_V) = 0;
  virtual void follow(const ShaftMotion<double>& motion) = 0;
  virtual void break_divider(std::size_t leg) = 0;
  virtual void request_run(bool run) = 0;
  virtual void request_clear() = 0;
  /// `config` must be the configuration of the same kind of firmware.
  virtual void retune(const DriveConfig<Command>& config, double setpoint_unit) = 0;
  virtual Diagnosis diagnosis() const = 0;
  virtual bool fault_ends_run() const = 0;
  virtual Registers* registers() = 0;     ///< null: the firmware receives ideal measurements
  virtual ShaftPorts* shaft_ports() = 0;  ///< null: the firmware has no shaft sensor

 protected:
  DriveInterface(const DriveInterface&) = default;
};

/// Configuration of a firmware. made() returns a drive with this configuration.
template <class Command>
class DriveConfig {
 public:
  DriveConfig() = default;
  DriveConfig(const DriveConfig&) = delete;
  DriveConfig& operator=(const DriveConfig&) = delete;
  virtual ~DriveConfig() = default;
  virtual std::unique_ptr<DriveInterface<Command>> made(const BoardConfig& board,
                                                        const PowerUp& power_up) const = 0;
  virtual bool decodes_arrangement() const = 0;
};

/// A firmware behind the common interface, as a value. A copy is an independent drive in the same state.
template <class CommandType>
class AnyDrive {
 public:
  using Number = double;
  using Command = CommandType;
  using Config = std::shared_ptr<const DriveConfig<Command>>;

  AnyDrive(const Config& config, const BoardConfig& board, const PowerUp& power_up)
      : drive_(config->made(board, power_up)), traits_(drive_->traits()) {}
  AnyDrive(const AnyDrive& other)
      : drive_(other.drive_->clone()), traits_(other.traits_), answer_(other.answer_) {}
  AnyDrive(AnyDrive&&) noexcept = default;
  AnyDrive& operator=(const AnyDrive& other) {
    if (this != &other) *this = AnyDrive(other);
    return *this;
  }
  AnyDrive& operator=(AnyDrive&&) noexcept = default;
  ~AnyDrive() = default;

  const Command& tick(const SampleInstant<double>& instant, double setpoint) {
    drive_->tick(instant, setpoint, answer_);
    return answer_.command;
  }
  const Command& hall_interrupt(std::uint8_t pins, const sim::Instant& at) {
    drive_->hall_interrupt(pins, at, answer_);
    return answer_.command;
  }
  const Command& commutation_interrupt(const sim::Instant& at) {
    drive_->commutation_interrupt(at, answer_);
    return answer_.command;
  }
  void captured(std::uint8_t pins, const sim::Instant& at) { drive_->captured(pins, at); }
  void captured_crossing(std::uint8_t lines, const sim::Instant& at) { drive_->captured_crossing(lines, at); }
  void look_at_terminals(const plant::PerLeg<double>& terminal_V) { drive_->look_at_terminals(terminal_V); }
  void follow(const ShaftMotion<double>& motion) { drive_->follow(motion); }
  void break_divider(std::size_t leg) { drive_->break_divider(leg); }
  void request_run(bool run) { drive_->request_run(run); }
  void request_clear() { drive_->request_clear(); }
  void retune(const Tuning<Config>& tuning) {
    drive_->retune(*tuning.config, tuning.setpoint_unit);
    traits_ = drive_->traits();
  }

  control::Mode mode() const { return traits_.mode; }
  bool open_loop() const { return traits_.open_loop; }
  bool follows_setpoint_at_once() const { return traits_.follows_setpoint_at_once; }
  bool follows_shaft() const { return traits_.follows_shaft; }
  bool wants_terminals() const { return traits_.wants_terminals; }
  bool reads_arrangement() const { return traits_.decodes_arrangement; }
  static bool reads_arrangement(const Config& config) { return config->decodes_arrangement(); }
  bool reversed() const { return answer_.reversed; }
  bool moved_on() const { return answer_.moved_on; }
  bool holds_commutation() const { return answer_.holds_commutation; }
  const sim::Instant& next_commutation() const { return answer_.next_commutation; }
  const control::Telemetry<double>& telemetry() const { return answer_.told; }
  const FieldTelemetry& field_held() const { return answer_.field; }
  Diagnosis diagnosis() const { return drive_->diagnosis(); }
  bool ends_run_by_fault() const { return drive_->fault_ends_run(); }
  Registers* registers() { return drive_->registers(); }
  ShaftPorts* shaft_ports() { return drive_->shaft_ports(); }
  const ShaftPorts* shaft_ports() const { return drive_->shaft_ports(); }

 private:
  std::unique_ptr<DriveInterface<Command>> drive_;
  DriveTraits traits_;
  DriveAnswer<Command> answer_{};
};

/// Drives whose command is a driven pair, and drives whose command is three legs.
using PairDrive = AnyDrive<control::BridgeCommand<double>>;
using LegDrive = AnyDrive<control::LegCommands<double>>;

}  // namespace sixstep::rig
