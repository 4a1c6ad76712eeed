// SPDX-License-Identifier: Apache-2.0
// Runs the control tick of each phase. sensorless.hpp shows the order of the phases.
#pragma once
#include <cstdint>

#include "sixstep/control/sensorless/captured_crossing.hpp"
#include "sixstep/control/sensorless/lock.hpp"
#include "sixstep/control/sensorless/observer.hpp"
#include "sixstep/control/sensorless/spin.hpp"
#include "sixstep/control/sensorless/start_up.hpp"

namespace sixstep::control {

enum class SensorlessPhase : std::uint8_t { off, catching, aligning, ramping, running, following, gave_up };

/// Default: the drive never starts. Choose speed.timeout_ticks above lock.longest_ticks.
template <class Scalar>
struct SensorlessConfig {
  ZeroCrossingConfig crossing{};
  CapturedCrossingConfig captured{};
  CommutationClockConfig clock{};
  SpinConfig spin{};
  StartUpConfig<Scalar> start{};
  LockConfig lock{};
  HallSpeedConfig<Scalar> speed{};  ///< speed from the crossings' times
  HallPositionConfig<Scalar> position{};
  bool operator==(const SensorlessConfig&) const = default;
};

struct SensorlessInput {
  TerminalSample terminals{};
  std::int8_t wanted = 0;      ///< required direction of rotation: 1, -1; 0: standstill or coasting
  bool on = false;             ///< true: the driven pair's switches are on at the sample
  std::uint32_t on_ticks = 0;  ///< timer ticks of the on-time around the sample; for comparators with half
                               ///< the bus as the reference
  Observed observed{};         ///< the observer's result
};

struct SensorlessState {
  SensorlessPhase phase = SensorlessPhase::off;
  std::int8_t direction = 1;
  std::uint8_t sector = 0;
  bool settled = false;  ///< true: in phase `catching` the currents have ended
  std::uint32_t commutated_at = 0;
  ZeroCrossingState crossing{};
  CapturedLines captured{};
  CommutationClockState clock{};
  SpinState spin{};
  StartUpState start{};
  LockState lock{};
  HallPositionState position{};
};

namespace detail {

constexpr std::uint8_t sectors_on(std::uint8_t sector, int n) {
  return static_cast<std::uint8_t>((sector + 12 + n) % 6);
}

template <class Scalar>
constexpr void begin_sector(const SensorlessConfig<Scalar>& config, SensorlessState& state, int sectors,
                            std::uint32_t now) {
  state.sector = sectors_on(state.sector, sectors);
  state.position.sectors += sectors;
  state.commutated_at = now;
  state.clock.scheduled = false;
  const std::uint32_t half = sector_ticks(config.clock, state.clock) / 2;
  const std::uint32_t since = now - state.clock.crossings.times[0];
  zero_crossing_begin(state.crossing, state.sector, since < half ? half - since : 0, now);
}

/// The crossing at the terminal, from samples or from the comparators' edges; not used during the start.
template <class Scalar>
constexpr CrossingReading crossing_of(const SensorlessConfig<Scalar>& config, SensorlessState& state,
                                      const SensorlessInput& input) {
  if (!config.captured.follows)
    return zero_crossing_step(config.crossing, state.crossing, input.terminals, input.on);
  return captured_crossing_step(config.captured, config.crossing, state.crossing, state.captured,
                                input.terminals, input.on, input.on_ticks);
}

constexpr void catch_spin(SensorlessState& state, std::uint32_t now) {
  state.phase = SensorlessPhase::catching;
  state.settled = false;
  state.clock = CommutationClockState{};
  spin_begin(state.spin, now);
}

template <class Scalar>
constexpr void begin_alignment(const SensorlessConfig<Scalar>& config, SensorlessState& state,
                               std::int8_t wanted, std::uint32_t now) {
  state.phase = SensorlessPhase::aligning;
  state.direction = wanted;
  state.clock = CommutationClockState{};
  align_begin(state.start, now);
  begin_sector(config, state, 0, now);
}

template <class Scalar>
constexpr void lose(const SensorlessConfig<Scalar>& config, SensorlessState& state, LockLoss loss,
                    std::uint32_t now) {
  const bool ends = lock_lost(config.lock, state.lock, loss);
  catch_spin(state, now);
  if (ends) state.phase = SensorlessPhase::gave_up;
}

/// Time of a crossing that was not found. If the old current hid the crossing, the result is the expected
/// time, otherwise the middle between the commutation and now.
template <class Scalar>
constexpr std::uint32_t passed_at(const SensorlessConfig<Scalar>& config, const SensorlessState& state,
                                  std::uint32_t now) {
  const std::uint32_t began = state.commutated_at;
  if (!state.crossing.hidden) return began + static_cast<std::uint32_t>(now - began) / 2;
  const std::uint32_t due = state.clock.crossings.times[0] + sector_ticks(config.clock, state.clock);
  return comes_before(due, began) ? began : comes_before(now, due) ? now : due;
}

/// Adds a crossing and schedules its commutation.
template <class Scalar>
constexpr void take_crossing(const SensorlessConfig<Scalar>& config, SensorlessState& state,
                             std::uint32_t at) {
  commutation_clock_crossing(state.clock, at, state.direction);
  const std::uint32_t T = sector_ticks(config.clock, state.clock);
  const std::uint32_t delay =
      T != 0 ? delay_ticks(config.clock, T) : static_cast<std::uint32_t>(at - state.commutated_at) / 2;
  schedule_commutation(state.clock, at + delay);
}

template <class Scalar>
constexpr void catching_step(const SensorlessConfig<Scalar>& config, SensorlessState& state,
                             const SensorlessInput& input) {
  const std::uint32_t now = input.terminals.at;
  if (input.wanted == 0) {
    state.phase = SensorlessPhase::off;
    return;
  }
  if (!state.settled) {
    if (static_cast<std::uint32_t>(now - state.spin.since) < config.spin.settle_ticks) return;
    state.settled = true;
    spin_begin(state.spin, now);
  }
  const SpinReading reading = spin_step(config.spin, state.spin, state.clock, input.terminals);
  const std::uint32_t T = sector_ticks(config.clock, state.clock);
  const bool found = spin_found(config.spin, state.spin);
  if (reading.crossed && found && T >= config.lock.shortest_ticks && T < config.start.trusted_ticks) {
    state.direction = reading.direction;
    state.sector = reading.sector;
    begin_sector(config, state, 0, now);
    state.crossing.done = true;
    schedule_commutation(state.clock, reading.at + delay_ticks(config.clock, T));
    lock_begin(state.lock);
    state.phase = SensorlessPhase::running;
    return;
  }
  const bool slow = found && T > config.start.trusted_ticks;
  if (slow || static_cast<std::uint32_t>(now - state.spin.since) >= config.spin.listen_ticks)
    begin_alignment(config, state, input.wanted, now);
}

template <class Scalar>
constexpr void aligning_step(const SensorlessConfig<Scalar>& config, SensorlessState& state,
                             const SensorlessInput& input) {
  const std::uint32_t now = input.terminals.at;
  if (input.wanted != state.direction) {
    state.phase = SensorlessPhase::off;
    return;
  }
  align_swing(config.start, state.start,
              zero_crossing_step(config.crossing, state.crossing, input.terminals, false));
  if (!align_step_ends(config.start, state.start, now)) return;
  if (state.start.step < 2) return begin_sector(config, state, state.direction, now);
  ramp_begin(config.start, state.start, now);
  begin_sector(config, state, 2 * state.direction, now);
  state.phase = SensorlessPhase::ramping;
}

template <class Scalar>
constexpr void ramping_step(const SensorlessConfig<Scalar>& config, SensorlessState& state,
                            const SensorlessInput& input) {
  const std::uint32_t now = input.terminals.at;
  if (input.wanted != state.direction) {
    state.phase = SensorlessPhase::off;
    return;
  }
  const CrossingReading reading =
      zero_crossing_step(config.crossing, state.crossing, input.terminals, input.on);
  if (state.crossing.unlike >= config.lock.unlike_samples)
    return lose(config, state, LockLoss::terminals, now);
  if (static_cast<std::uint32_t>(now - state.start.since) > config.start.longest_ticks)
    return lose(config, state, LockLoss::start, now);
  if (reading.crossing == Crossing::seen) take_crossing(config, state, reading.at);
  const bool waits = state.crossing.armed && !state.crossing.done;
  if (ramp_step(config.start, state.start, reading, waits, state.clock.scheduled)) {
    state.clock.crossings = HallSpeedState{};  // the next interval would contain a missed crossing, so the
                                               // times are cleared
    begin_sector(config, state, state.direction, now);
    ramp_commutated(state.start);
    return;
  }
  const std::uint32_t T = sector_ticks(config.clock, state.clock);
  if (state.start.trusted < config.start.trusted || T == 0 || T > config.start.trusted_ticks) return;
  lock_begin(state.lock);
  state.phase = SensorlessPhase::running;
}

template <class Scalar>
constexpr void running_step(const SensorlessConfig<Scalar>& config, SensorlessState& state,
                            const SensorlessInput& input) {
  const std::uint32_t now = input.terminals.at;
  const CrossingReading reading =
      input.observed.follows
          ? observed_crossing_step(config.crossing, state.crossing, input.terminals, input.observed, input.on)
          : crossing_of(config, state, input);
  if (reading.crossing != Crossing::none) {
    const std::uint32_t at = reading.crossing == Crossing::seen ? reading.at : passed_at(config, state, now);
    const std::uint32_t T = sector_ticks(config.clock, state.clock);
    const LockLoss loss = lock_crossing(config.lock, state.lock, reading.crossing,
                                        static_cast<std::uint32_t>(at - state.clock.crossings.times[0]),
                                        state.clock.guessed ? 0 : T, state.crossing.hidden);
    if (loss != LockLoss::none) return lose(config, state, loss, now);
    if (reading.crossing == Crossing::seen) return take_crossing(config, state, at);
    commutation_clock_guess(state.clock, T, state.direction, now);
    const std::uint32_t sooner = sector_ticks(config.clock, state.clock);  // less than T if the crossing was
                                                                           // early
    return schedule_commutation(state.clock, at + delay_ticks(config.clock, sooner < T ? sooner : T));
  }
  const std::uint32_t T = sector_ticks(config.clock, state.clock);
  LockLoss loss =
      reading.free ? lock_sample(config.lock, state.lock, reading.y, state.crossing.done, T) : LockLoss::none;
  const std::uint32_t since =
      state.clock.scheduled ? 0 : static_cast<std::uint32_t>(now - state.clock.crossings.times[0]);
  if (loss == LockLoss::none)
    loss = lock_waiting(config.lock, since, T, state.crossing.freewheels && state.crossing.hidden,
                        state.crossing.unlike);
  if (loss == LockLoss::none) return;
  if (input.wanted == state.direction) return lose(config, state, loss, now);
  catch_spin(state, now);  // the rotor coasted or was braked as commanded, so this is not a loss
}

/// If observed.by_level is set and the crossing was found, the flux linkage determines the commutation, not
/// the clock.
constexpr void commutate_by_level(SensorlessState& state, const SensorlessInput& input) {
  if (!input.observed.by_level || state.phase != SensorlessPhase::running) return;
  if (!state.crossing.done || state.clock.guessed) return;
  state.clock.scheduled = false;
  if (input.observed.due) schedule_commutation(state.clock, input.terminals.at + input.observed.due_ticks);
}

}  // namespace detail

}  // namespace sixstep::control
