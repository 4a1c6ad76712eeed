// SPDX-License-Identifier: Apache-2.0
// Controllers that command three legs, on the virtual board. A controller is a function of a tick's inputs.
#pragma once
#include "sixstep/rig/rig.hpp"
#include "tests/support/board.hpp"

namespace sixstep::testing {

/// The type Controller has LegCommands<double> operator()(instant, setpoint), and may have a state.
template <class Controller>
class ThreeLegFirmware {
 public:
  using Number = double;
  using Config = Controller;
  using Command = control::LegCommands<double>;
  static constexpr bool fault_ends_run = true;

  ThreeLegFirmware(const Controller& controller, const rig::BoardConfig&, const rig::PowerUp&)
      : controller_(controller) {}

  template <class Real>
  Command tick(const rig::SampleInstant<Real>& instant, double setpoint) {
    return controller_(instant, setpoint);
  }
  void captured(std::uint8_t, const sim::Instant&) {}
  void retune(const rig::Tuning<Config>& tuning) { controller_ = tuning.config; }
  void request_run(bool) {}
  void request_clear() {}
  bool open_loop() const { return false; }
  bool follows_setpoint_at_once() const { return false; }
  rig::Diagnosis diagnosis() const { return {}; }

 private:
  Controller controller_;
};

template <class Controller>
using ThreeLegRig = rig::Rig<double, ThreeLegFirmware<Controller>>;

template <class Controller>
ThreeLegRig<Controller> three_leg_rig(const Board& b, const Controller& controller) {
  return ThreeLegRig<Controller>(b.plant(), controller, b.board, b.timeline);
}

/// A controller that commands the same legs in every period.
struct HeldLegs {
  control::LegCommands<double> legs;

  template <class Real>
  control::LegCommands<double> operator()(const rig::SampleInstant<Real>&, double) const {
    return legs;
  }
};

inline control::LegCommands<double> complementary(double a, double b, double c) {
  constexpr control::LegState pwm = control::LegState::pwm;
  constexpr control::PwmSwitches both = control::PwmSwitches::complementary;
  return {.enabled = true, .leg = {{pwm, both, a}, {pwm, both, b}, {pwm, both, c}}};
}

}  // namespace sixstep::testing
