// SPDX-License-Identifier: Apache-2.0
// Walks of the parts that exist only in floating point. Most are parts of the field-oriented drive: the
// magnet's angle without a sensor, currents along a shape, and the selection among the legs' states. The
// position profile is also in this file.
#pragma once
#include "sixstep/control/field/sensorless_field_drive.hpp"
#include "sixstep/control/jerk_profile.hpp"
#include "tests/target/walk/field.hpp"

namespace target {

template <class Scalar>
AlphaBeta<Scalar> drawn_vector(Random& r) {
  const Scalar alpha = signal<Scalar>(r);
  return {alpha, signal<Scalar>(r)};
}

/// The direction of a random angle, computed as a chip does.
template <class Scalar>
Direction<Scalar> drawn_direction(Random& r) {
  return direction_of<Scalar>(r.long_bits());
}

template <class Scalar>
InjectionConfig<Scalar> drawn_injection(Random& r) {
  const Scalar voltage_V = positive<Scalar>(r, 8192);
  return {voltage_V, gain<Scalar>(r, -2)};
}

template <class Scalar>
PolarityConfig<Scalar> drawn_north(Random& r) {
  const Scalar current_A = positive<Scalar>(r);
  const Gain<Scalar> certain = positive_gain<Scalar>(r, 2, 4);
  const auto settle = static_cast<std::uint16_t>(r.below(4));
  return {current_A, certain, settle, static_cast<std::uint16_t>(1 + r.below(6))};
}

template <class Scalar>
ActiveFluxConfig<Scalar> drawn_flux(Random& r) {
  ActiveFluxConfig<Scalar> c{};
  c.period_s = positive_gain<Scalar>(r, 4);
  c.R_ohm = positive_gain<Scalar>(r, 0);
  c.L_q_H = positive_gain<Scalar>(r, 1);
  c.L_D_H = gain<Scalar>(r, 2);
  c.magnet_Vs = positive<Scalar>(r);
  c.pull = positive_gain<Scalar>(r, 2);
  return c;
}

template <class Scalar>
struct InjectionWalk {
  InjectionConfig<Scalar> config{};
  InjectionState<Scalar> state{};
  std::uint8_t late = 0;

  void draw(Random& r) {
    config = drawn_injection<Scalar>(r);
    late = r.below(3);
  }
  void step(Random& r, Digest& mix) {
    const AlphaBeta<Scalar> current = drawn_vector<Scalar>(r);
    const Direction<Scalar> along = drawn_direction<Scalar>(r);
    const bool on = !r.one_in(8);
    const Dq<Scalar> h =
        counted<0>("injection_response", [&] { return injection_response(state, current, late); });
    const Scalar v =
        counted<1>("injected_voltage", [&] { return injected_voltage(config, state, along, on); });
    mix(h.d, h.q, v);
    saw("a response", h.d != Scalar{});
    saw("no pulse behind", h.d == Scalar{} && h.q == Scalar{});
  }
};

template <class Scalar>
struct NorthWalk {
  PolarityConfig<Scalar> config{};
  NorthState<Scalar> state{};

  void draw(Random& r) {
    config = drawn_north<Scalar>(r);
    state = NorthState<Scalar>{};
  }
  void step(Random& r, Digest& mix) {
    const Scalar h = positive<Scalar>(r);
    counted<0>("north_step", [&] { north_step(config, state, h); });
    const Scalar i = north_current(config, state);
    mix(static_cast<std::uint8_t>(state.phase), i, state.forth, state.back);
    saw("north", state.phase == NorthPhase::found);
    saw("south", state.phase == NorthPhase::opposite);
    saw("neither", state.phase == NorthPhase::unseen);
    if (state.phase != NorthPhase::forth && state.phase != NorthPhase::back) state = NorthState<Scalar>{};
  }
};

template <class Scalar>
struct ActiveFluxWalk {
  ActiveFluxConfig<Scalar> config{};
  ActiveFluxState<Scalar> state{};

  void draw(Random& r) { config = drawn_flux<Scalar>(r); }
  void step(Random& r, Digest& mix) {
    const AlphaBeta<Scalar> u = drawn_vector<Scalar>(r), i = drawn_vector<Scalar>(r);
    const Direction<Scalar> magnet = drawn_direction<Scalar>(r);
    const Scalar ahead =
        counted<0>("active_flux_step", [&] { return active_flux_step(config, state, u, i, magnet); });
    mix(ahead, state.flux.alpha, state.flux.beta, state.along);
    saw("behind the magnet", state.along < Scalar{});
    saw("ahead", ahead > Scalar{} && ahead < Scalar(1));
  }
};

template <class Scalar>
EstimatorConfig<Scalar> drawn_estimator(Random& r) {
  EstimatorConfig<Scalar> c{};
  c.on = true;
  c.tracking.K_p = FixedGain<std::int32_t>::from_raw(
      static_cast<std::int32_t>(std::int32_t{1} + (r.bits() & 0x7fff)) * 65536, 34);
  c.tracking.K_i = FixedGain<std::int32_t>::from_raw(
      static_cast<std::int32_t>(std::int32_t{1} + (r.bits() & 0x7fff)) * 65536, 38);
  c.rad_s = Number<Scalar>::gain(static_cast<std::int16_t>(r.bits() & 0x7fff), 44);
  c.late = r.below(2);
  c.in_middle = r.one_in(3);
  c.flux = drawn_flux<Scalar>(r);
  c.axis_ticks = r.below(8);
  if (r.one_in(2)) {
    c.injection = drawn_injection<Scalar>(r);
    c.north = drawn_north<Scalar>(r);
    if (r.one_in(2)) c.flux = ActiveFluxConfig<Scalar>{};
  } else {
    c.start.current_A = positive<Scalar>(r);
    c.start.align_ticks = 2u + r.below(8);
    c.start.step = static_cast<std::int64_t>(1 + r.bits()) << 26;
    c.start.enough = static_cast<std::int64_t>(1 + r.bits()) << 28;
    c.start.good_ticks = r.below(8);
    c.start.retries = r.below(4);
  }
  c.low_rad_s = positive<Scalar>(r, 8192);
  c.high_rad_s = c.low_rad_s * Scalar(2);
  return c;
}

/// The whole drive with its loops. Each new configuration restarts it.
template <class Scalar>
struct SensorlessFieldWalk {
  SensorlessFieldConfig<Scalar> config{};
  SensorlessFieldState<Scalar> state{};
  Telemetry<Scalar> telemetry{};
  Setpoint<Scalar> setpoint{};

  void draw(Random& r) {
    config = SensorlessFieldConfig<Scalar>{};
    config.field.drive = drawn_drive<Scalar>(r);
    config.field.current = drawn_field_current<Scalar>(r);
    config.field.advance.rad_s = positive_gain<Scalar>(r, -2);
    config.estimator = drawn_estimator<Scalar>(r);
    state.estimator = EstimatorState<Scalar>{};
  }
  void step(Random& r, Digest& mix) {
    if (r.one_in(16)) setpoint.value = signal<Scalar>(r);
    FieldDriveInput<Scalar> in{};
    in.measured = drawn_measurement<Scalar>(r);
    const LegCommands<Scalar> answer = counted<0>("sensorless_field_step", [&] {
      return sensorless_field_step(config, state, in, setpoint, telemetry);
    });
    const EstimatorState<Scalar>& e = state.estimator;
    mix_legs(mix, answer);
    mix(e.sampled, e.speed_rad_s, e.weight, static_cast<std::uint8_t>(e.phase));
    saw("the axis", e.phase == EstimatorPhase::axis && e.begun);
    saw("north", e.phase == EstimatorPhase::north);
    saw("turns it", e.phase == EstimatorPhase::ramping);
    saw("follows", e.phase == EstimatorPhase::following);
    saw("gives up", answer.fault);
    saw("by the flux", e.weight > Scalar{});
  }
};

template <class Scalar>
HarmonicCurrentConfig<Scalar> drawn_shape(Random& r) {
  HarmonicCurrentConfig<Scalar> c{};
  c.on = true;
  c.lead_rad_s = positive_gain<Scalar>(r, 0);
  c.half_turn_s = positive_gain<Scalar>(r, 0);
  c.slope_V_A = positive_gain<Scalar>(r, 0);
  c.R_ohm = positive_gain<Scalar>(r, 0);
  c.least = Scalar(0.75);
  for (Dq<Scalar>& g : c.shape) {
    g.d = signal<Scalar>(r) * Scalar(0.125);
    g.q = Scalar(1) + signal<Scalar>(r) * Scalar(0.125);
  }
  return c;
}

template <class Scalar>
struct HarmonicCurrentWalk {
  HarmonicCurrentConfig<Scalar> config{};

  void draw(Random& r) { config = drawn_shape<Scalar>(r); }
  void step(Random& r, Digest& mix) {
    const BinaryAngle magnet = r.long_bits();
    const Scalar speed = signal<Scalar>(r), I = signal<Scalar>(r), weakening = -positive<Scalar>(r);
    const Dq<Scalar> i =
        counted<0>("harmonic_current", [&] { return harmonic_current(config, magnet, speed, I, weakening); });
    const TakenAlong<Scalar> to =
        counted<1>("taken_along", [&] { return taken_along(config, magnet, speed, I, weakening); });
    mix(i.d, i.q, to.current.d, to.current.q, to.voltage.d, to.voltage.q);
    saw("forth", i.q > Scalar{});
    saw("back", i.q < Scalar{});
  }
};

template <class Scalar>
struct FiniteSetWalk {
  FiniteSetConfig<Scalar> config{};
  FiniteSetState<Scalar> state{};

  void draw(Random& r) {
    config = FiniteSetConfig<Scalar>{};
    config.on = true;
    config.foretells = r.one_in(2);
    config.d_decay = config.q_decay = positive_gain<Scalar>(r, 0, 1);
    config.d_A_per_V = positive_gain<Scalar>(r, 1);
    config.q_A_per_V = positive_gain<Scalar>(r, 1);
    config.half_turn_s = positive_gain<Scalar>(r, 0);
    config.salient_V_s_A = gain<Scalar>(r, 2);
    if (r.one_in(2)) config.switching_A = positive<Scalar>(r, 8192);
    if (r.one_in(2)) config.most_A = positive<Scalar>(r);
  }
  void step(Random& r, Digest& mix) {
    FiniteSetInput<Scalar> in{};
    in.reference = {signal<Scalar>(r), Scalar{}};
    in.measured = {signal<Scalar>(r), Scalar{}};
    in.reference.q = signal<Scalar>(r);
    in.measured.q = signal<Scalar>(r);
    in.magnet = drawn_direction<Scalar>(r);
    in.speed_rad_s = signal<Scalar>(r);
    in.bus_V = drawn_bus<Scalar>(r);
    in.e.q = in.e_next.q = signal<Scalar>(r);
    const LegBits before = state.legs;
    const LegBits legs = counted<0>("finite_set_step", [&] { return finite_set_step(config, state, in); });
    mix(legs, state.foretold.d, state.foretold.q);
    saw("stays", legs == before);
    saw("one leg", legs_changed(before, legs) == 1);
    saw("all legs", legs_changed(before, legs) == 3);
  }
};

template <class Scalar>
struct JerkProfileWalk {
  JerkProfileConfig<Scalar> config{};
  JerkProfileState<Scalar> state{};
  Scalar target{};

  void draw(Random& r) {
    config = JerkProfileConfig<Scalar>{};
    config.counts_per_deg = Scalar(1048576.0);
    config.cells = static_cast<std::uint8_t>(1 + r.below(jerk_profile_cells));
    config.ticks = static_cast<std::uint16_t>(1 + r.below(3));
    config.stride_per_tick = config.ticks == 1 ? Scalar(1) : Scalar(0.5);
    config.deg_per_part = Scalar(1.0 / 1048576.0 / 64.0);
    config.rad_s_per_part = config.rad_s2_per_part = Scalar(1.0 / 67108864.0);
    config.acceleration = std::int32_t{1} << (12 + r.below(14));
    const Scalar at = signal<Scalar>(r);
    counted<1>("begin_profile", [&] { begin_profile(config, state, at, Scalar{}); });
    target = at;
  }
  void step(Random& r, Digest& mix) {
    if (r.one_in(24)) target = signal<Scalar>(r) * Scalar(256);
    const ProfiledMotion<Scalar> now =
        counted<0>("jerk_profile_step", [&] { return jerk_profile_step(config, state, target); });
    mix(now.position_deg, now.speed_rad_s, now.acceleration_rad_s2, state.way, state.rest);
    saw("moves", now.speed_rad_s != Scalar{});
    saw("has landed", now.speed_rad_s == Scalar{} && now.position_deg == target);
  }
};

}  // namespace target
