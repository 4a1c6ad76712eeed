// SPDX-License-Identifier: Apache-2.0
// Drive whose firmware runs on an emulated chip with a separate clock, register by register (chip_port.hpp).
// The board turns the chip on at t = 0, sets the chip's Hall pins and converter inputs, and applies the gates
// that the chip sets.
//
//               input at a sample                           a Hall edge   a fault            reports
//   ChipDrive   counts at the converter's inputs: currents  its pins      handled by the     cycles of its interrupts
//               of the legs, the setpoint's potentiometer                 firmware itself
//
// The plant cannot predict when the chip changes its gates, and the chip cannot predict when a Hall edge
// occurs. The chip therefore runs ahead of the plant over a time in which no edge is expected. It stops when
// it changes gates or samples. If an edge nevertheless occurs in this time, the pins show the edge at the
// chip's next stop.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sixstep/rig/chip_port.hpp"
#include "sixstep/rig/firmware.hpp"
#include "sixstep/rig/gate_modulator.hpp"

namespace sixstep::rig {

/// Channels of the converter: legs a, b, c, then the setpoint's potentiometer.
constexpr std::size_t potentiometer_input = 3;

struct ChipConfig {
  control::Mode mode = control::Mode::off;
  double setpoint_range = 1.0;  ///< in the mode's unit: the potentiometer goes from -setpoint_range to
                                ///< setpoint_range
  std::uint32_t full_counts = 1024;
  bool operator==(const ChipConfig&) const = default;
};

class ChipDrive {
 public:
  using Number = double;
  using Command = ChipGates;
  using Config = ChipConfig;
  static constexpr bool fault_ends_run = true;

  ChipDrive(const Config& config, const BoardConfig& board, const PowerUp& power_up)
      : config_(config),
        port_(board.chip),
        registers_(board.sensors),
        bases_(board.bases),
        patience_s_(std::max(
            least_patience_s,
            patient_periods * static_cast<double>(board.modulator.period_ticks) / sim::ticks_per_second)),
        pins_(power_up.pins) {}

  /// Instant of the chip's present stop. The plant must advance to this instant.
  const sim::Instant& next_stop() const { return stop_; }
  bool samples() const { return answer_.event == ChipEvent::sample; }
  /// True at the control sample: the sample of a current, once per period.
  bool samples_current() const { return samples() && answer_.channel < potentiometer_input; }
  bool lost() const { return trouble_ != CoreTrouble::none; }
  ChipGates gates() const { return {answer_.gates}; }

  /// Sets the counts at the converter's inputs. Call it at a stop that samples.
  template <class Real>
  void sample(const SampleInstant<Real>& instant, double setpoint) {
    const Sample s = sample_of(instant);
    for (std::size_t k = 0; k < 3; ++k) run_.counts[k] = registers_.current_counts(k, s.i_A[k], s.number);
    const double half = config_.full_counts / 2.0;
    const double counts = std::floor(half + half * setpoint / config_.setpoint_range + 0.5);
    run_.counts[potentiometer_input] =
        static_cast<std::uint16_t>(std::clamp(counts, 0.0, config_.full_counts - 1.0));
    if (!samples_current()) return;
    sampled_ = instant.at;
    telemetry_.motor_current_A =
        control::motor_current(ideal_measurement<double>(instant, bases_),
                               control::positive_pair(control::sector_of_hall(instant.pins)));
    if (config_.mode == control::Mode::current) telemetry_.current_reference_A = setpoint;
  }
  /// Runs the chip from this stop to its next stop, for at most `quiet_s` seconds.
  void go_on(double quiet_s) {
    const double cycles =
        std::clamp(quiet_s * static_cast<double>(port_.clock_Hz), least_cycles, most_cycles);
    run_.until = answer_.cycle + static_cast<std::uint64_t>(cycles);
    run_.hall_pins = pins_;
    note_lateness();
    trouble_ = port_.run(port_.chip, run_, answer_);
    if (trouble_ == CoreTrouble::none && answer_.event == ChipEvent::ended) trouble_ = CoreTrouble::gone;
    if (trouble_ == CoreTrouble::none && port_.converts &&
        sim::seconds_between(sampled_, stop_) > patience_s_)
      trouble_ = CoreTrouble::stalled;
    stop_ = lost() ? stop_ : at_cycle(answer_.cycle);
  }
  void captured(std::uint8_t pins, const sim::Instant& at) {
    pins_ = pins;
    edge_ = at;
    edge_waits_ = true;
  }
  void request_run(bool) {}
  void request_clear() {}
  void retune(const Tuning<Config>&) {}

  control::Mode mode() const { return config_.mode; }
  bool reversed() const { return false; }
  bool open_loop() const { return false; }
  bool follows_setpoint_at_once() const { return false; }
  const control::Telemetry<double>& telemetry() const { return telemetry_; }
  Diagnosis diagnosis() const { return {.at = stop_, .core = trouble_}; }
  /// Largest delay from an edge of the probes to the same edge at the chip's pins, s.
  double latest_edge_s() const { return latest_edge_s_; }

 private:
  /// Bounds of the time between stops, in cycles. At 16 MHz 8 cycles are half a microsecond, short enough
  /// near a Hall edge. 400 cycles are a fraction of a PWM period, short enough far from an edge.
  static constexpr double least_cycles = 8, most_cycles = 400;
  /// A chip that does not sample for this time counts as stalled. The time is longer than the shortest
  /// watchdog time plus the restart after the watchdog's reset.
  static constexpr double patient_periods = 50, least_patience_s = 30e-3;

  sim::Instant at_cycle(std::uint64_t cycle) const {
    const auto whole_s = static_cast<std::int64_t>(cycle / port_.clock_Hz);
    const double rest = static_cast<double>(cycle % port_.clock_Hz) *
                        (sim::ticks_per_second / static_cast<double>(port_.clock_Hz));
    return sim::Instant{whole_s * static_cast<std::int64_t>(sim::ticks_per_second), 0.0}.plus_ticks(rest);
  }
  void note_lateness() {
    if (!edge_waits_) return;
    latest_edge_s_ = std::max(latest_edge_s_, sim::seconds_between(edge_, stop_));
    edge_waits_ = false;
  }

  Config config_;
  ChipPort port_;
  Registers registers_;
  Bases bases_;
  ChipRun run_{};
  ChipAnswer answer_{};
  CoreTrouble trouble_ = CoreTrouble::none;
  double patience_s_;
  sim::Instant stop_{};  ///< the first stop is at t = 0
  sim::Instant sampled_{};
  std::uint8_t pins_;
  bool edge_waits_ = false;
  sim::Instant edge_{};
  double latest_edge_s_ = 0.0;
  control::Telemetry<double> telemetry_{};
};

}  // namespace sixstep::rig
