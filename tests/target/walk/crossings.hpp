// SPDX-License-Identifier: Apache-2.0
// Walks of the blocks of sensorless/ without a scalar: crossings, their clock, the lock, and a rotor that
// spins freely.
#pragma once
#include "sixstep/control/sensorless/captured_crossing.hpp"
#include "sixstep/control/sensorless/lock.hpp"
#include "sixstep/control/sensorless/spin.hpp"
#include "tests/target/walk/counted.hpp"
#include "tests/target/walk/digest.hpp"
#include "tests/target/walk/terminals.hpp"

namespace target {

struct ZeroCrossingWalk {
  ZeroCrossingConfig config{};
  ZeroCrossingState state{};
  TerminalRotor rotor{};
  std::uint32_t now = 0;
  std::uint8_t sector = no_sector, late = 0;

  void draw(Random& r) {
    config = {r.one_in(3) ? NeutralSeen::freewheel : NeutralSeen::on_time,
              static_cast<std::uint16_t>(20 + r.below(40)), r.below(100), r.below(60),
              r.below(8) * tick_ticks / 4};
    rotor.speed = drawn_pace(r);
    late = r.below(4);
  }
  void step(Random& r, Digest& mix) {
    now += tick_ticks;
    rotor.angle += static_cast<std::uint32_t>(rotor.speed);
    if (rotor.sector() != sector && !(late > 0 && r.one_in(2))) {
      sector = rotor.sector();
      rotor.driven = r.one_in(32) ? r.below(6) : sector;
      rotor.demagnetises = r.below(4);
      const std::uint32_t earliest = r.one_in(2) ? 0 : std::uint32_t{r.below(4)} * tick_ticks;
      counted<1>("zero_crossing_begin", [&] { zero_crossing_begin(state, rotor.driven, earliest, now); });
    }
    const bool on = config.seen == NeutralSeen::on_time ? !r.one_in(16) : r.one_in(16);
    const std::int32_t noise = drawn_noise(r, 20);
    const TerminalSample sample = r.one_in(24) ? wild_sample(r, now) : rotor.sample(now, on, noise);
    const CrossingReading reading =
        counted<0>("zero_crossing_step", [&] { return zero_crossing_step(config, state, sample, on); });
    mix(static_cast<std::uint8_t>(reading.crossing), reading.at, reading.visible, reading.free, reading.y);
    mix(state.hidden, state.armed, state.unlike, state.freewheel, state.blank);
    saw("seen", reading.crossing == Crossing::seen);
    saw("passed before", reading.crossing == Crossing::passed_before);
    saw("hidden", state.hidden);
    saw("not visible", !reading.visible);
    saw("a contradiction", state.unlike > 0);
  }
};

/// Comparators at the same terminals. Their lines change between two samples.
struct CapturedCrossingWalk {
  ZeroCrossingWalk by{};
  CapturedCrossingConfig config{};
  CapturedLines captured{};

  void draw(Random& r) {
    by.draw(r);
    const bool half_bus = r.one_in(3);
    config = {true, std::uint32_t{r.below(8)} * 20, half_bus ? tick_ticks : 0,
              std::uint32_t{r.below(4)} * 16};
  }
  void step(Random& r, Digest& mix) {
    by.now += tick_ticks;
    by.rotor.angle += static_cast<std::uint32_t>(by.rotor.speed);
    if (by.rotor.sector() != by.sector) {
      by.sector = by.rotor.sector();
      by.rotor.driven = r.one_in(32) ? r.below(6) : by.sector;
      by.rotor.demagnetises = r.below(4);
      zero_crossing_begin(by.state, by.rotor.driven, std::uint32_t{r.below(4)} * tick_ticks, by.now);
    }
    const TerminalSample sample =
        r.one_in(24) ? wild_sample(r, by.now) : by.rotor.sample(by.now, true, drawn_noise(r, 20));
    std::uint8_t lines = 0;
    for (std::uint8_t k = 0; k < 3; ++k)
      if (above_neutral(sample, k) > 0) lines = static_cast<std::uint8_t>(lines | 4u >> k);
    const std::uint32_t edge = by.now - std::uint32_t{r.below(16)} * (tick_ticks / 16);
    counted<1>("capture_lines", [&] { capture_lines(captured, lines, edge); });
    const std::uint32_t on = std::uint32_t{r.below(16)} * (tick_ticks / 16);
    const CrossingReading reading = counted<0>("captured_crossing_step", [&] {
      return captured_crossing_step(config, by.config, by.state, captured, sample, true, on);
    });
    mix(static_cast<std::uint8_t>(reading.crossing), reading.at, reading.visible, reading.free, reading.y);
    mix(by.state.armed, by.state.done, captured.came_back, captured.at[0], captured.at[1], captured.at[2]);
    saw("by an edge", reading.crossing == Crossing::seen && captured.came_back);
    saw("by samples", reading.crossing == Crossing::seen && !captured.came_back);
    saw("passed before", reading.crossing == Crossing::passed_before);
    saw("in a pause", config.period_ticks > 0 && reading.crossing == Crossing::seen &&
                          reading.at == by.now - tick_ticks / 2);
  }
};

struct CommutationClockWalk {
  CommutationClockConfig config{};
  CommutationClockState state{};
  std::uint32_t now = 0, pace = 5000;
  std::int8_t direction = 1;

  void draw(Random& r) {
    config = {r.below(8), r.bits(), std::uint32_t{r.below(100)} * 16};
    pace = 2000 + (r.long_bits() >> r.below(16) >> 8);
    if (r.one_in(2)) direction = static_cast<std::int8_t>(-direction);
  }
  void step(Random& r, Digest& mix) {
    now += pace + r.long_bits() % (pace / 4);
    const std::uint32_t before = sector_ticks(config, state);
    const bool guesses = r.one_in(6);
    if (guesses)
      counted<1>("commutation_clock_guess", [&] { commutation_clock_guess(state, before, direction, now); });
    else
      counted<0>("commutation_clock_crossing", [&] { commutation_clock_crossing(state, now, direction); });
    std::uint32_t T = 0;
    const std::uint32_t delay = counted<2>("sector_ticks+delay_ticks", [&] {
      T = sector_ticks(config, state);
      return delay_ticks(config, T);
    });
    mix(T, delay, state.crossings.times[0], state.crossings.times[1], state.guessed);
    saw("guessed", state.guessed);
    saw("knows no sector", T == 0);
    saw("at once", T != 0 && delay == 0);
    saw("later", delay != 0);
  }
};

struct LockWalk {
  LockConfig config{};
  LockState state{};
  std::uint32_t T = 10000;

  void draw(Random& r) {
    config = {static_cast<std::uint8_t>(8 + r.below(16)),
              static_cast<std::uint8_t>(1 + r.below(4)),
              static_cast<std::uint8_t>(2 + r.below(6)),
              std::uint32_t{r.below(8)} * 500,
              std::uint32_t{200000},
              r.long_bits() >> 5,
              std::int32_t{r.below(100)},
              r.below(4),
              r.below(20)};
    T = r.one_in(8) ? 0 : 2000 + (r.bits() & 0x3fffu);
    lock_begin(state);
  }
  void step(Random& r, Digest& mix) {
    const bool passed = r.one_in(6), hides = r.one_in(3), crossed = r.one_in(2);
    const Crossing crossing = passed ? Crossing::passed_before : Crossing::seen;
    const std::uint32_t interval = r.one_in(6) ? r.bits() : T + r.below(200);
    const auto any = static_cast<std::int32_t>(static_cast<std::int16_t>(r.bits()));
    const std::int32_t y = any / (r.one_in(4) ? 16 : 256);
    const std::uint32_t since = r.one_in(16) ? r.long_bits() >> 12 : r.bits() & 0x3fffu;
    const std::uint8_t unlike = r.one_in(16) ? r.below(8) : std::uint8_t{0};
    const LockLoss by_crossing = counted<0>(
        "lock_crossing", [&] { return lock_crossing(config, state, crossing, interval, T, hides); });
    const LockLoss by_sample =
        counted<1>("lock_sample", [&] { return lock_sample(config, state, y, crossed, T); });
    const LockLoss by_waiting =
        counted<2>("lock_waiting", [&] { return lock_waiting(config, since, T, hides, unlike); });
    const LockLoss loss = by_crossing != LockLoss::none ? by_crossing
                          : by_sample != LockLoss::none ? by_sample
                                                        : by_waiting;
    bool gives_up = false;
    if (loss != LockLoss::none) gives_up = lock_lost(config, state, loss);
    mix(static_cast<std::uint8_t>(loss), state.hidden, state.early, state.odd, state.jumps, state.losses,
        state.held, gives_up);
    if (gives_up) state = {};
    saw("holds", loss == LockLoss::none);
    saw("a masked crossing", loss == LockLoss::masked_crossing);
    saw("a long demagnetisation", loss == LockLoss::long_demagnetisation);
    saw("a wrong sector", loss == LockLoss::wrong_sector);
    saw("terminals that contradict", loss == LockLoss::terminals);
    saw("gives up", gives_up);
  }
};

struct SpinWalk {
  SpinConfig config{};
  SpinState state{};
  CommutationClockState clock{};
  TerminalRotor rotor{};
  std::uint32_t now = 0;

  void draw(Random& r) {
    config = {20 + r.below(60), static_cast<std::uint8_t>(2 + r.below(5)), 0, 0};
    rotor.speed = r.one_in(6) ? 0 : drawn_pace(r);
    if (!r.one_in(4)) return;
    spin_begin(state, now);
    clock = {};
  }
  void step(Random& r, Digest& mix) {
    now += tick_ticks;
    if (r.one_in(64)) rotor.speed = -rotor.speed;
    rotor.angle += static_cast<std::uint32_t>(rotor.speed);
    const std::int32_t noise = drawn_noise(r, 12);
    const TerminalSample sample = r.one_in(64) ? wild_sample(r, now) : rotor.sample(now, false, noise);
    const SpinReading reading =
        counted<0>("spin_step", [&] { return spin_step(config, state, clock, sample); });
    const bool found = spin_found(config, state);
    mix(reading.crossed, reading.direction, reading.sector, reading.at, state.signs, state.found, found,
        clock.crossings.known);
    saw("forward", reading.crossed && reading.direction > 0);
    saw("back", reading.crossed && reading.direction < 0);
    saw("found", found);
    saw("signs that no rotor makes", state.signs == 7 || state.signs == 0);
  }
};

}  // namespace target
