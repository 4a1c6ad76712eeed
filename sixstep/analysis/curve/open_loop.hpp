// SPDX-License-Identifier: Apache-2.0
// Simulates motor and bridge on the virtual board with a constant duty.
#pragma once
#include "sixstep/analysis/curve/bench.hpp"
#include "sixstep/rig/lean_rig.hpp"
#include "sixstep/sim/run.hpp"

namespace sixstep::analysis {

class OpenLoop {
 public:
  OpenLoop(const Bench& b, const plant::Plant<double>& plant)
      : keep_going_(b.keep_going),
        rig_(plant, drive_of(b), board_of(b), {{sim::Instant{}, rig::ActionKind::setpoint, b.duty}}) {}

  /// Runs for some seconds. Stop::observer: Bench::keep_going ended the run.
  template <class Observer>
  sim::Stop run_for(double seconds, Observer& observer) {
    Asking<Observer> asking{keep_going_, observer};
    return sim::run(rig_, rig_.now().plus_seconds(seconds), asking).stop;
  }
  sim::Stop run_for(double seconds) {
    sim::NoObserver none;
    return run_for(seconds, none);
  }
  std::int64_t sectors() const { return rig_.event_count(rig::EventKind::sector_edge); }
  const plant::Plant<double>& plant() const { return rig_.plant(); }

 private:
  static rig::BoardConfig board_of(const Bench& b) {
    rig::BoardConfig board;
    board.modulator.period_ticks = std::max<std::int64_t>(1, sim::to_instant(b.pwm_period_s).ticks);
    return board;
  }
  static control::DriveConfig<double> drive_of(const Bench& b) {
    control::DriveConfig<double> drive;
    drive.mode = control::Mode::duty;
    drive.chopping = b.chopping;
    drive.nominal_bus_V = b.voltage_V;
    return drive;
  }

  std::function<bool()> keep_going_;
  rig::LeanRig<double> rig_;
};

}  // namespace sixstep::analysis
