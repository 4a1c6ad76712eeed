// SPDX-License-Identifier: Apache-2.0
// Firmware that executes a user's controller (control/own/own_controller.h). The table's columns are as in
// firmware.hpp:
//
//              input of a tick                         a Hall edge          a fault         reports
//   OwnDrive   ideal values, or those of [sensors],    captured, its hall   ends the run    lost sensor, invalid
//              and the magnet's direction                                                   answer
//
// Its command is a pair or three legs, according to the template argument. An answer that the timer cannot
// execute ends the run, and diagnosis() returns the reason.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sixstep/control/commutation.hpp"
#include "sixstep/control/drive.hpp"
#include "sixstep/control/field/field_direction.hpp"
#include "sixstep/control/own/own_controller.h"
#include "sixstep/rig/firmware.hpp"
#include "sixstep/rig/magnet_angle.hpp"
#include "sixstep/rig/own_answer.hpp"

namespace sixstep::rig {

/// A user's controller and the bytes that its `design` function wrote. `is` is null if the scenario has no
/// user's controller.
struct OwnConfig {
  const sixstep_controller* is = nullptr;
  std::vector<std::uint64_t> config;
  control::Mode mode = control::Mode::off;
  std::string file;  ///< file of the controller, for messages
  bool operator==(const OwnConfig&) const = default;
};

/// Memory of at least `bytes` bytes, all zero, with the alignment of operator new.
inline std::vector<std::uint64_t> zero_bytes(std::size_t bytes) {
  return std::vector<std::uint64_t>(bytes / 8 + 1);
}

template <class CommandType>
class OwnDrive {
 public:
  using Number = double;
  using Command = CommandType;
  using Config = OwnConfig;
  static constexpr bool fault_ends_run = true;

  OwnDrive(const Config& config, const BoardConfig& board, const PowerUp& power_up)
      : config_(config),
        state_(zero_bytes(config.is->state_bytes)),
        sensors_(board.sensors, board.bases, power_up),
        ideal_(board.sensors.ideal()),
        by_hall_(board.sensors.rotor_from_hall) {
    if (config_.is->start) config_.is->start(config_.config.data(), state_.data());
  }

  template <class Real>
  const Command& tick(const SampleInstant<Real>& instant, double setpoint) {
    control::Measurement<double> measured = ideal_measurement<double>(instant, Bases{});
    if (!ideal_) sensors_.sense(measured, sample_of(instant));
    const control::Direction<double> magnet = magnet_direction(instant.state, measured.hall);
    const sixstep_measured seen{.current_A = {measured.i_a_A, measured.i_b_A, measured.i_c_A},
                                .speed_rad_s = measured.speed_rad_s,
                                .position_deg = measured.position_deg,
                                .bus_V = measured.bus_V,
                                .magnet_cos = magnet.cos,
                                .magnet_sin = magnet.sin,
                                .hall = measured.hall};
    ++steps_;
    config_.is->step(config_.config.data(), state_.data(), &seen, setpoint, &answer_);
    take(measured.hall, instant.at, false);
    const std::uint8_t sector = control::sector_of_hall(measured.hall);
    telemetry_.motor_current_A = control::motor_current(measured, control::positive_pair(sector));
    telemetry_.duty = reversed_ ? -answer_.duty : answer_.duty;
    telemetry_.current_reference_A = answer_.current_reference_A;
    telemetry_.speed_reference_rad_s = answer_.speed_reference_rad_s;
    if (sensors_.shaft_found().lost()) {
      command_ = given_up();
    }
    return command_;
  }
  void captured(std::uint8_t pins, const sim::Instant& at) { sensors_.hall_edge(pins, at); }
  const Command& hall_interrupt(std::uint8_t pins, const sim::Instant& at) {
    if (config_.is->hall == nullptr) return command_;
    config_.is->hall(config_.config.data(), state_.data(), pins, &answer_);
    take(pins, at, true);
    if (command_.enabled) sensors_.commutated();
    return command_;
  }
  void request_run(bool) {}
  void request_clear() {}
  /// Replaces the configuration and keeps the controller's state.
  void retune(const Tuning<Config>& tuning) { config_ = tuning.config; }

  control::Mode mode() const { return config_.mode; }
  /// True if the pair in the last answer produces negative torque.
  bool reversed() const { return reversed_; }
  bool open_loop() const { return false; }
  bool follows_setpoint_at_once() const { return false; }
  const control::Telemetry<double>& telemetry() const { return telemetry_; }
  Diagnosis diagnosis() const {
    Diagnosis found{
        .hall_line = sensors_.broken_line(), .at = wrong_at_, .shaft = sensors_.shaft_found(), .own = wrong_};
    found.shunt_samples = sensors_.low_side().samples;
    found.blind_samples = sensors_.low_side().blind;
    found.own.controller = config_.file.c_str();
    return found;
  }
  Registers& registers() { return sensors_.registers(); }
  ShaftPorts& shaft_ports() { return sensors_.shaft_ports(); }
  const ShaftPorts& shaft_ports() const { return sensors_.shaft_ports(); }
  bool follows_shaft() const { return sensors_.follows_shaft(); }
  template <class Real>
  void follow(const ShaftMotion<Real>& motion) {
    sensors_.follow(motion);
  }

 private:
  /// This is a separate function, because GCC 12 stops with an internal error if Command{} is assigned to a
  /// member.
  static Command given_up() {
    Command command{};
    command.fault = true;
    return command;
  }
  /// Direction of the magnet. With an angle sensor: the decoded angle. With Hall codes only: the middle of
  /// the sector. Without sensors: the true direction.
  template <class Real>
  control::Direction<double> magnet_direction(const plant::State<Real>& s, std::uint8_t hall) {
    if (sensors_.tells_angle())
      return control::direction_of<double>(control::magnet_angle(sensors_.electrical_angle()));
    if (!by_hall_) return direction_at<double>(magnet_rad(s));
    if (const std::uint8_t sector = control::sector_of_hall(hall); sector != control::no_sector)
      sector_ = sector;
    return direction_at<double>((sector_ + 0.5) * base::sector_rad - magnet_behind_rad);
  }
  void take(std::uint8_t hall, const sim::Instant& at, bool in_hall) {
    OwnFinding wrong = wrong_in<Command>(answer_);
    if (wrong.what == OwnWrong::none) {
      command_ = command_of<Command>(answer_);
    } else {
      command_ = given_up();
      wrong.steps = steps_;
      wrong.in_hall = in_hall;
      wrong_ = wrong;
      wrong_at_ = at;
    }
    if constexpr (requires { command_.pair; }) {
      const std::uint8_t sector = control::sector_of_hall(hall);
      reversed_ =
          sector != control::no_sector && command_.pair == control::swapped(control::positive_pair(sector));
    }
  }

  Config config_;
  std::vector<std::uint64_t> state_;
  Sensors<double> sensors_;
  bool ideal_, by_hall_;
  bool reversed_ = false;
  std::uint8_t sector_ = 0;  ///< sector of the last valid Hall code
  sixstep_answer answer_{};
  Command command_{};
  control::Telemetry<double> telemetry_{};
  std::int64_t steps_ = 0;
  OwnFinding wrong_{};
  sim::Instant wrong_at_{};
};

}  // namespace sixstep::rig
