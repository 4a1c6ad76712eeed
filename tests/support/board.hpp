// SPDX-License-Identifier: Apache-2.0
// The reference motor on the virtual board. Many tests use this board.
#pragma once
#include "sixstep/rig/lean_rig.hpp"
#include "tests/support/maxon.hpp"

namespace sixstep::testing {

/// A motor on a board. The configurations select open or closed loop. Each rig receives a copy of the
/// timeline.
struct Board : Drivetrain {
  control::DriveConfig<double> drive{.mode = control::Mode::duty, .nominal_bus_V = 24.0};
  rig::BoardConfig board{};
  rig::Timeline timeline{};

  static Board duty(double d, control::Chopping chopping = control::Chopping::soft) {
    Board s;
    s.drive.chopping = chopping;
    s.setpoint(0, d);
    return s;
  }
  /// Hysteresis control of the motor current by event comparators.
  static Board hysteresis(double i_ref, double band, control::Chopping chopping) {
    Board s;
    s.drive.mode = control::Mode::current;
    s.drive.current_control = control::CurrentControl::hysteresis;
    s.drive.hysteresis = {band, control::Watch::motor};
    s.drive.chopping = chopping;
    s.setpoint(0, i_ref);
    return s;
  }
  void setpoint(std::int64_t ticks, double value) {
    timeline.push_back({{ticks, 0.0}, rig::ActionKind::setpoint, value});
  }
  void load(std::int64_t ticks, double torque) {
    timeline.push_back({{ticks, 0.0}, rig::ActionKind::load_torque, torque});
  }
  template <class Real = double>
  rig::LeanRig<Real, double> rig() const {
    return rig::LeanRig<Real, double>(plant<Real>(), drive, board, timeline);
  }
};

template <class Rig, class Observer>
sim::Stop run_to(Rig& rig, double t_s, Observer& observer) {
  return sim::run(rig, sim::to_instant(t_s), observer).stop;
}
template <class Rig>
sim::Stop run_to(Rig& rig, double t_s) {
  sim::NoObserver none;
  return run_to(rig, t_s, none);
}

}  // namespace sixstep::testing
