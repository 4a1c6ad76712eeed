// SPDX-License-Identifier: Apache-2.0
// The lean drive with a random configuration that changes during the run. The walk covers all combinations of
// the drive's parts, which no single exported drive contains.
#pragma once
#include "sixstep/control/drive.hpp"
#include "sixstep/control/retune.hpp"
#include "tests/target/walk/legs.hpp"
#include "tests/target/walk/sensing.hpp"
#include "tests/target/walk/whole.hpp"

namespace target {

template <class Scalar>
DriveExtras<Scalar> drawn_extras(Random& r) {
  DriveExtras<Scalar> e{};
  e.on = !r.one_in(3);
  e.slews_setpoint = r.one_in(2);
  e.slew = {Number<Scalar>::sum(static_cast<std::int32_t>(r.long_bits() >> 6))};
  e.limits_current = r.one_in(2);
  LimitsWalk<Scalar> limits{};
  limits.draw(r);
  e.limits = limits.config;
  e.torque_fraction_per_A = positive_gain<Scalar>(r, 0);
  e.feed_forward = {positive_gain<Scalar>(r, 0)};
  if (r.one_in(2)) e.bus = {positive<Scalar>(r)};
  e.smooth_chopping = r.one_in(2);
  e.chopping = {Number<Scalar>::part(0x20000000), Number<Scalar>::part(0x10000000)};
  e.speed_law = r.one_in(2) ? SpeedLaw::positional : SpeedLaw::pi;
  e.speed = {gain<Scalar>(r, -2), gain<Scalar>(r, 3), positive_gain<Scalar>(r, 1), positive<Scalar>(r),
             gain<Scalar>(r, 4)};
  e.speed_derivative = {gain<Scalar>(r, 0), positive_gain<Scalar>(r, 1)};
  return e;
}

template <class Scalar>
DriveConfig<Scalar> drawn_drive(Random& r) {
  DriveConfig<Scalar> c{};
  c.mode = static_cast<Mode>(r.below(5));
  c.chopping = static_cast<Chopping>(r.below(3));
  c.current_control = r.one_in(4) ? CurrentControl::hysteresis : CurrentControl::pi;
  c.current = {gain<Scalar>(r, -3), gain<Scalar>(r, 2), positive<Scalar>(r)};
  c.hysteresis = {positive<Scalar>(r, 4000), static_cast<Watch>(r.below(3))};
  c.nominal_bus_V = Number<Scalar>::divisor(static_cast<std::int16_t>(r.bits() & 0x7fff), 14);
  c.speed = {gain<Scalar>(r, -3), gain<Scalar>(r, 2), positive<Scalar>(r)};
  c.current_at_full_torque_A = positive_gain<Scalar>(r, -1);
  c.current_limit_A = positive<Scalar>(r);
  c.position_gain = positive_gain<Scalar>(r, -3);
  c.speed_limit_rad_s = positive<Scalar>(r);
  c.speed_control = r.one_in(4) ? SpeedControl::duty : SpeedControl::cascade;
  c.extras = drawn_extras<Scalar>(r);
  return c;
}

template <class Scalar>
struct DrawnDriveWalk {
  DriveConfig<Scalar> config{};
  DriveState<Scalar> state{};
  Telemetry<Scalar> telemetry{};
  Setpoint<Scalar> setpoint{};

  void draw(Random& r) {
    DriveConfig<Scalar> next = drawn_drive<Scalar>(r);
    // The following parts exist only in drives with Hall probes.
    next.extras.pwm = {static_cast<PwmPattern>(r.below(pwm_patterns)), positive_gain<Scalar>(r, 0)};
    next.extras.staying_phase = r.one_in(2);
    next.extras.steps_commutation = r.one_in(2);
    next.extras.commutation = {
        positive_gain<Scalar>(r, 0),  positive_gain<Scalar>(r, -1),
        positive_gain<Scalar>(r, -2), r.one_in(2) ? Scalar{} : positive<Scalar>(r, 8000),
        positive_gain<Scalar>(r, 0),  positive_gain<Scalar>(r, -4),
        positive_gain<Scalar>(r, -4), signal<Scalar>(r)};
    retune(config, state, next);
  }
  void step(Random& r, Digest& mix) {
    if (r.one_in(16)) setpoint.value = signal<Scalar>(r);
    Measurement<Scalar> m = drawn_measurement<Scalar>(r);
    if (r.one_in(64)) m.hall = r.below(8);
    if (r.one_in(8)) {
      const BridgeCommand<Scalar>& moved = on_hall(config, state, m.hall);
      mix_command(mix, moved);
      mix(static_cast<std::uint8_t>(moved.chopped), moved.overlap);
    }
    const BridgeCommand<Scalar> answer = sixstep::control::step(config, state, m, setpoint, telemetry);
    mix_command(mix, answer);
    mix(static_cast<std::uint8_t>(answer.chopped), answer.overlap);
    mix(telemetry.motor_current_A, telemetry.current_reference_A, telemetry.speed_reference_rad_s,
        telemetry.duty, state.current.u, state.speed.u, state.extras.speed.integral);
    saw("off", !answer.enabled);
    saw("a fault", answer.fault);
    saw("coasts", !answer.enabled && !answer.fault && config.mode != Mode::off);
    saw("reversed", answer.enabled && state.reversed);
    saw("all the bus", answer.duty == one<Scalar>);
    saw("chops the lower switch", answer.enabled && answer.chopped == ChoppedSwitch::lower);
    saw("comparators armed", answer.watch != Watch::none);
    saw("chops otherwise than configured", answer.enabled && answer.chopping != config.chopping);
  }
};

}  // namespace target
