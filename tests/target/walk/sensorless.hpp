// SPDX-License-Identifier: Apache-2.0
// Walks of the start, of the position without a sensor, and of the whole drive. The rotor is aligned, ramped,
// caught and lost.
#pragma once
#include "sixstep/control/sensorless/sensorless_drive.hpp"
#include "tests/target/walk/drawn_drive.hpp"
#include "tests/target/walk/terminals.hpp"

namespace target {

template <class Scalar>
StartUpConfig<Scalar> drawn_start(Random& r) {
  StartUpConfig<Scalar> start{};
  start.current_A = positive<Scalar>(r);
  start.falling_A = positive<Scalar>(r);
  start.align_ticks = (16 + std::uint32_t{r.below(32)}) * tick_ticks;
  start.swing_shift = static_cast<std::uint8_t>(2 + r.below(4));
  start.swing_threshold = 10 + r.below(40);
  start.first_speed = 40000000 + (r.long_bits() >> 7);  // 100 to 60 ticks per sector
  start.acceleration = 1000000 + (r.long_bits() >> 11);
  start.jerk = r.one_in(2) ? 0 : std::uint32_t{r.bits()} * 256;
  start.last_speed = 0x20000000;  // 8 ticks per sector
  start.longest_ticks = 400 * tick_ticks;
  start.trusted = static_cast<std::uint8_t>(2 + r.below(3));
  start.trusted_ticks = 40 * tick_ticks;
  return start;
}

template <class Scalar>
SensorlessConfig<Scalar> drawn_sensorless(Random& r) {
  SensorlessConfig<Scalar> c{};
  c.crossing = {NeutralSeen::on_time, std::uint16_t{30}, 10 + r.below(40), 10 + r.below(40),
                std::uint32_t{r.below(4)} * 500};
  c.clock = {static_cast<std::uint8_t>(1 + r.below(6)), static_cast<std::uint16_t>(r.bits() & 0x1fff),
             r.below(100)};
  c.spin = {60 + r.below(60), static_cast<std::uint8_t>(2 + r.below(3)), 2 * tick_ticks,
            r.one_in(4) ? 0 : 40 * tick_ticks};
  c.start = drawn_start<Scalar>(r);
  c.lock.tolerated = static_cast<std::uint8_t>(2 + r.below(3));
  c.lock.shortest_ticks = 2 * tick_ticks;
  c.lock.longest_ticks = 100 * tick_ticks;
  c.lock.threshold = 60;
  c.lock.retries = r.below(4);
  c.lock.sectors_to_forget = 30;
  c.speed = {Number<Scalar>::ratio(r.bits()), 200 * tick_ticks, static_cast<std::uint8_t>(1 + r.below(6)), 0,
             1};
  c.position = {gain<Scalar>(r, -9), gain<Scalar>(r, 1)};
  return c;
}

template <class Scalar>
struct StartUpWalk {
  StartUpConfig<Scalar> config{};
  StartUpState state{};
  std::uint32_t now = 0;

  void draw(Random& r) {
    config = drawn_start<Scalar>(r);
    align_begin(state, now);
  }
  void step(Random& r, Digest& mix) {
    now += tick_ticks;
    CrossingReading reading{};
    reading.visible = !r.one_in(4);
    reading.y = drawn_noise(r, 100);
    const std::uint8_t kind = r.below(32);
    if (kind < 3) reading.crossing = kind < 2 ? Crossing::seen : Crossing::passed_before;
    const bool waits = r.one_in(2), scheduled = r.one_in(4);
    counted<1>("align_swing", [&] { align_swing(config, state, reading); });
    const bool ends = counted<2>("align_step_ends", [&] { return align_step_ends(config, state, now); });
    if (ends && r.one_in(2)) ramp_begin(config, state, now);
    const bool turns =
        counted<0>("ramp_step", [&] { return ramp_step(config, state, reading, waits, scheduled); });
    mix(ends, turns, state.swing, state.falls, state.angle, state.speed, state.faster, state.ticks,
        state.waited, state.trusted, state.passed);
    if (turns) ramp_commutated(state);
    saw("a step that ends", ends);
    saw("a sector that ends", turns);
    saw("a swing that falls", state.falls);
    saw("waits", state.waited > 0);
    saw("crossings to trust", state.trusted >= config.trusted);
    saw("at the last speed", state.speed == config.last_speed);
  }
};

/// The course of a run: the requested direction, the torque of a pair, and changes of the rotor's speed by an
/// external drive.
struct Course {
  TerminalRotor rotor{};
  std::uint32_t now = 0;
  std::int32_t pull = 900000;
  std::uint8_t sections = 0;
  std::int8_t wanted = 1;

  void draw(Random& r) {
    ++sections;
    if (sections % 8 == 0) wanted = r.one_in(2) ? std::int8_t{1} : std::int8_t{-1};
    if (sections % 8 == 7) wanted = 0;              // coasts; if the drive has given up, it may start again
    if (r.one_in(16)) rotor.speed = drawn_pace(r);  // an external drive turns the rotor
    if (r.one_in(32)) rotor.speed = 0;
    pull = 600000 + static_cast<std::int32_t>(r.bits()) * 16;
  }
  TerminalSample tick(Random& r, const DrivenPair& pair, bool on) {
    now += tick_ticks;
    if (r.one_in(1024)) rotor.angle += half_turn;
    rotor.turn(pair, pull);
    const std::int32_t noise = drawn_noise(r, 6);
    return r.one_in(768) ? wild_sample(r, now) : rotor.sample(now, on, noise);
  }
};

inline void mix_sensorless(Digest& mix, const SensorlessState& s) {
  mix(static_cast<std::uint8_t>(s.phase), s.direction, s.sector, s.commutated_at, s.clock.next,
      s.clock.scheduled, s.clock.guessed, s.crossing.hidden, s.crossing.y, s.spin.found, s.start.speed,
      s.start.trusted, static_cast<std::uint8_t>(s.lock.last), s.lock.losses);
  saw("off", s.phase == SensorlessPhase::off);
  saw("catches", s.phase == SensorlessPhase::catching);
  saw("aligns", s.phase == SensorlessPhase::aligning);
  saw("ramps", s.phase == SensorlessPhase::ramping);
  saw("runs forward", s.phase == SensorlessPhase::running && s.direction > 0);
  saw("runs back", s.phase == SensorlessPhase::running && s.direction < 0);
  saw("lost", s.lock.losses > 0);
  saw("gave up", s.phase == SensorlessPhase::gave_up);
}

template <class Scalar>
struct SensorlessWalk {
  SensorlessConfig<Scalar> config{};
  SensorlessState state{};
  Course course{};
  DrivenPair pair{};

  void draw(Random& r) {
    course.draw(r);
    if (course.sections % 16 == 1) config = drawn_sensorless<Scalar>(r);
  }
  void commutate(Random& r) {
    const std::uint32_t at = state.clock.next;
    if (!state.clock.scheduled || !comes_before(at, course.now + tick_ticks) || r.one_in(32)) return;
    if (state.phase != SensorlessPhase::ramping && state.phase != SensorlessPhase::running) return;
    counted<1>("sensorless_commutate", [&] { sensorless_commutate(config, state, at); });
  }
  void step(Random& r, Digest& mix) {
    commutate(r);
    const bool on = !r.one_in(64);
    const SensorlessInput input{course.tick(r, pair, on), course.wanted, on};
    counted<0>("sensorless_step", [&] { sensorless_step(config, state, input); });
    SensorlessAnswer<Scalar> answer{};
    Scalar speed{};
    const Scalar position = counted<2>("sensorless_answer+sensorless_speed+sensorless_position", [&] {
      answer = sensorless_answer(config, state, course.wanted);
      speed = sensorless_speed(config, state, course.now);
      return sensorless_position(config, state, course.now);
    });
    const Pair positive = positive_pair(state.sector);
    const bool forward = answer.by_start ? answer.start_A >= Scalar{} : state.direction > 0;
    pair = {answer.drives, forward ? positive : swapped(positive)};
    mix_sensorless(mix, state);
    mix(answer.drives, answer.by_start, answer.start_A, speed, position, course.rotor.angle);
    saw("knows a speed", speed != Scalar{});
  }
};

template <class Scalar>
SensorlessDriveConfig<Scalar> drawn_sensorless_drive(Random& r) {
  SensorlessDriveConfig<Scalar> next{drawn_drive<Scalar>(r), drawn_sensorless<Scalar>(r)};
  if (next.drive.mode == Mode::off) next.drive.mode = Mode::duty;
  next.drive.extras.on = false;  // the walk "drive+retune" tests the extras
  next.source.has_hall = r.one_in(2);
  next.source.wanted = r.one_in(2) ? RotorSource::hall : RotorSource::back_emf;
  next.source.falls_back = !r.one_in(4);
  next.source.agreed = static_cast<std::uint8_t>(2 + r.below(6));
  next.start_output = positive<Scalar>(r);
  next.duty.step = Number<Scalar>::sum(static_cast<std::int32_t>(r.long_bits() >> 8));
  next.current.step = Number<Scalar>::sum(static_cast<std::int32_t>(r.long_bits() >> 8));
  next.least_duty = positive<Scalar>(r, 4000);
  return next;
}

/// The whole drive: loops and start. The commutation is by Hall probes and by back-EMF in turn.
template <class Scalar>
struct SensorlessDriveWalk {
  SensorlessDriveConfig<Scalar> config{};
  SensorlessDriveState<Scalar> state{};
  Telemetry<Scalar> telemetry{};
  Setpoint<Scalar> setpoint{};
  Course course{};
  std::uint8_t sector = 0;

  void draw(Random& r) {
    course.draw(r);
    setpoint.value = positive<Scalar>(r);
    if (course.wanted == 0) setpoint.value = Scalar{};
    if (course.wanted < 0) setpoint.value = -setpoint.value;
    if (course.sections % 16 == 1) configure(r);
  }
  void configure(Random& r) {
    SensorlessDriveConfig<Scalar> next = drawn_sensorless_drive<Scalar>(r);
    if (course.sections % 32 == 17) {
      next.source = config.source;  // probes remain available during the run
      return retune(config, state, next);
    }
    config = next;
    state = {};
  }
  void commutate(Random& r, Digest& mix) {
    std::uint32_t at = 0;
    if (!next_commutation(state, at) || !comes_before(at, course.now + tick_ticks) || r.one_in(32)) return;
    mix_command(mix, counted<1>("sensorless_drive_commutate",
                                [&] { return sensorless_drive_commutate(config, state, at); }));
  }
  std::uint8_t pins(Random& r) const {
    return r.one_in(2048) ? std::uint8_t{7} : hall_of_sector(course.rotor.sector());
  }
  static Scalar calm(Random& r) {
    return Number<Scalar>::part(static_cast<std::int32_t>(r.long_bits()) / 256);
  }
  void edge(Random& r, Digest& mix) {
    if (course.rotor.sector() == sector) return;
    sector = course.rotor.sector();
    const std::uint8_t read = pins(r);
    const std::uint32_t captured = course.now - r.bits() % 1000;
    mix(counted<2>("sensorless_drive_hall",
                   [&] { return sensorless_drive_hall(config, state, read, captured); }));
  }
  void step(Random& r, Digest& mix) {
    commutate(r, mix);
    SensorlessDriveInput<Scalar> in{drawn_measurement<Scalar>(r)};
    if (course.sections % 4 != 0) {
      in.measured.i_a_A = calm(r);
      in.measured.i_b_A = calm(r);
      in.measured.i_c_A = calm(r);
    }
    in.on = !r.one_in(64);
    const BridgeCommand<Scalar>& was = state.drive.command;
    in.terminals = course.tick(r, {was.enabled, was.pair}, in.on);
    edge(r, mix);
    in.hall_pins = pins(r);
    const BridgeCommand<Scalar> answer = counted<0>("sensorless_drive_step", [&] {
      return sensorless_drive_step(config, state, in, setpoint, telemetry);
    });
    mix_command(mix, answer);
    mix_sensorless(mix, state.sensorless);
    mix(static_cast<std::uint8_t>(state.source.source), state.source.broken, state.source.agreed,
        state.by_start, state.setpoint.y, telemetry.motor_current_A, telemetry.duty);
    saw("follows probes", state.source.source == RotorSource::hall);
    saw("a line that died", state.source.broken);
    saw("a fault", answer.fault);
  }
};

}  // namespace target
