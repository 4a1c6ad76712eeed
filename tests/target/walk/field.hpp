// SPDX-License-Identifier: Apache-2.0
// Walks of the field-oriented drive and of its blocks: currents on the d and q axes.
#pragma once
#include "sixstep/control/field/field_drive.hpp"
#include "tests/target/walk/drawn_drive.hpp"
#include "tests/target/walk/legs.hpp"

namespace target {

template <class Scalar>
FieldCurrentConfig<Scalar> drawn_field_current(Random& r) {
  FieldCurrentConfig<Scalar> c{};
  c.d = {gain<Scalar>(r, -3), gain<Scalar>(r, 2), positive<Scalar>(r)};
  c.q = {gain<Scalar>(r, -3), gain<Scalar>(r, 2), positive<Scalar>(r)};
  c.limit = r.one_in(3) ? VoltageLimit::axes : VoltageLimit::circle;
  c.decouples = !r.one_in(3);
  c.d_V_s_A = positive_gain<Scalar>(r, 0);
  c.q_V_s_A = positive_gain<Scalar>(r, 0);
  c.magnet_V_s = positive_gain<Scalar>(r, 0);
  c.R_ohm = positive_gain<Scalar>(r, 0);
  return c;
}

template <class Scalar>
FieldWeakeningConfig<Scalar> drawn_weakening(Random& r) {
  FieldWeakeningConfig<Scalar> c{positive_gain<Scalar>(r, 2), positive_gain<Scalar>(r, 0, 2), Scalar{}};
  if (!r.one_in(3)) c.most_A = positive<Scalar>(r);
  return c;
}

/// A random configuration. At full current, its value is at most 0.7.
template <class Scalar>
TorquePerAmpereConfig<Scalar> drawn_per_ampere(Random& r) {
  const auto m = static_cast<std::int16_t>(r.bits() % 22937);
  return {r.one_in(4) ? Gain<Scalar>{} : Number<Scalar>::gain(m, static_cast<std::int8_t>(15 + r.below(3)))};
}

template <class Scalar>
Scalar drawn_bus(Random& r) {
  return r.one_in(8) ? signal<Scalar>(r) : positive<Scalar>(r);
}

template <class Scalar>
struct FieldCurrentWalk {
  FieldCurrentConfig<Scalar> config{};
  FieldCurrentState<Scalar> state{};

  void draw(Random& r) { config = drawn_field_current<Scalar>(r); }
  void step(Random& r, Digest& mix) {
    const Dq<Scalar> reference{signal<Scalar>(r), signal<Scalar>(r)};
    const Dq<Scalar> measured{signal<Scalar>(r), signal<Scalar>(r)};
    const Scalar speed = signal<Scalar>(r), bus = drawn_bus<Scalar>(r);
    const Dq<Scalar> e =
        counted<1>("turning_voltage", [&] { return turning_voltage(config, measured, speed); });
    const Scalar circle = counted<2>("voltage_circle", [&] { return voltage_circle(bus); });
    const Dq<Scalar> v = counted<0>("field_current_step", [&] {
      return field_current_step(config, state, reference, measured, speed, bus);
    });
    mix(e.d, e.q, circle, v.d, v.q, state.d.u, state.q.u);
    const bool by_circle = config.limit == VoltageLimit::circle && circle > Scalar{};
    saw("d has the whole circle", by_circle && magnitude(v.d) == circle);
    saw("q has the rest", by_circle && v.d != Scalar{} && magnitude(v.q) == circle_rest(circle, v.d));
    saw("within the circle", by_circle && magnitude(v.q) < circle_rest(circle, v.d));
    saw("at its own limit", config.limit == VoltageLimit::axes && magnitude(v.q) == config.q.limit);
    saw("no bus", circle == Scalar{});
  }
};

template <class Scalar>
struct ReachableCurrentWalk {
  FieldCurrentConfig<Scalar> config{};

  void draw(Random& r) { config = drawn_field_current<Scalar>(r); }
  void step(Random& r, Digest& mix) {
    const Dq<Scalar> wanted{signal<Scalar>(r), signal<Scalar>(r)};
    const Scalar speed = signal<Scalar>(r), bus = drawn_bus<Scalar>(r);
    const Dq<Scalar> i =
        counted<0>("reachable_current", [&] { return reachable_current(config, wanted, speed, bus); });
    mix(i.d, i.q);
    saw("it can be held", i == wanted);
    saw("less of what drives", i.d == wanted.d && i.q != wanted.q);
    saw("to the rim", i.d != wanted.d);
  }
};

template <class Scalar>
struct FieldDirectionWalk {
  FieldAdvanceConfig<Scalar> config{};

  void draw(Random& r) { config.rad_s = positive_gain<Scalar>(r, -2); }
  void step(Random& r, Digest& mix) {
    const BinaryAngle electrical = r.long_bits();
    const Scalar speed = signal<Scalar>(r);
    const FieldDirections<Scalar> d =
        counted<0>("field_directions", [&] { return field_directions(config, electrical, speed); });
    mix(d.sampled.cos, d.sampled.sin, d.answered.cos, d.answered.sin);
    saw("does not turn on", d.sampled.cos == d.answered.cos && d.sampled.sin == d.answered.sin);
    saw("turns on", d.sampled.cos != d.answered.cos);
  }
};

template <class Scalar>
struct FieldWeakeningWalk {
  FieldWeakeningConfig<Scalar> config{};
  FieldCurrentConfig<Scalar> current{};
  FieldWeakeningState<Scalar> state{};

  void draw(Random& r) {
    config = drawn_weakening<Scalar>(r);
    current = drawn_field_current<Scalar>(r);
  }
  void step(Random& r, Digest& mix) {
    const Dq<Scalar> v{signal<Scalar>(r), signal<Scalar>(r)};
    const Scalar bus = drawn_bus<Scalar>(r), speed = signal<Scalar>(r), most = positive<Scalar>(r);
    const Scalar i_d =
        counted<0>("field_weakening_step", [&] { return field_weakening_step(config, state, v, bus); });
    const Scalar left =
        counted<1>("voltage_bound", [&] { return voltage_bound(config, current, speed, bus, most); });
    mix(i_d, state.i_d, left);
    saw("weakens", i_d < Scalar{} && i_d > -config.most_A);
    saw("as much as it may", config.most_A > Scalar{} && i_d == -config.most_A);
    saw("weakens nothing", i_d == Scalar{});
    saw("bounds the torque", left < most);
  }
};

template <class Scalar>
struct TorquePerAmpereWalk {
  TorquePerAmpereConfig<Scalar> config{};

  void draw(Random& r) { config = drawn_per_ampere<Scalar>(r); }
  void step(Random& r, Digest& mix) {
    const Scalar i_q = signal<Scalar>(r);
    const Scalar i_d = counted<0>("least_current_d", [&] { return least_current_d(config, i_q); });
    mix(i_d);
    saw("a round rotor", config.k_per_A == Gain<Scalar>{});
    saw("a current against the magnet", i_d < Scalar{});
  }
};

/// The whole drive with its loops. The configuration changes during the run.
template <class Scalar>
struct FieldDriveWalk {
  FieldDriveConfig<Scalar> config{};
  FieldDriveState<Scalar> state{};
  Telemetry<Scalar> telemetry{};
  Setpoint<Scalar> setpoint{};

  void draw(Random& r) {
    FieldDriveConfig<Scalar> next{};
    next.drive = drawn_drive<Scalar>(r);
    next.current = drawn_field_current<Scalar>(r);
    next.weakening = drawn_weakening<Scalar>(r);
    next.per_ampere = drawn_per_ampere<Scalar>(r);
    next.advance.rad_s = positive_gain<Scalar>(r, -2);
    counted<1>("retune", [&] { retune(config, state, next); });
  }
  void step(Random& r, Digest& mix) {
    if (r.one_in(16)) setpoint.value = signal<Scalar>(r);
    FieldDriveInput<Scalar> in{};
    in.measured = drawn_measurement<Scalar>(r);
    in.magnet = field_directions(config.advance, r.long_bits(), in.measured.speed_rad_s);
    const LegCommands<Scalar> answer = counted<0>(
        "field_drive_step", [&] { return field_drive_step(config, state, in, setpoint, telemetry); });
    mix_legs(mix, answer);
    mix(state.measured.d, state.measured.q, state.reference.d, state.reference.q, state.current.voltage.d,
        state.current.voltage.q, telemetry.motor_current_A, telemetry.current_reference_A,
        telemetry.speed_reference_rad_s);
    saw("off", !answer.enabled);
    saw("holds a current", answer.enabled && config.drive.mode == Mode::current);
    saw("holds a speed", answer.enabled && config.drive.mode == Mode::speed);
    saw("holds a position", answer.enabled && config.drive.mode == Mode::position);
    saw("weakens", answer.enabled && state.weakening.i_d < Accumulator<Scalar>{});
  }
};

}  // namespace target
