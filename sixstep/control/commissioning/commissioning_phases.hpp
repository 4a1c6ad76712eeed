// SPDX-License-Identifier: Apache-2.0
// Runs the control tick of each commissioning phase. The order of the phases is in commissioning.hpp.
#pragma once
#include <cstdint>

#include "sixstep/control/commissioning/flux_turn.hpp"
#include "sixstep/control/commissioning/hall_survey.hpp"

namespace sixstep::control {

enum class CommissioningPhase : std::uint8_t {
  zeroing,
  rising,
  leaning,
  aligning,
  stepping,
  turning,
  spinning,
  measuring,
  done,
  failed
};

enum class CommissioningFault : std::uint8_t {
  none,
  offset,     ///< the offset of an amplifier is out of tolerance
  current,    ///< the longest vector does not reach the test current: a wire is open, or the test current is
              ///< too high
  winding,    ///< the currents of the two levels allow no result for resistance or time constant
  not_turned  ///< the rotor did not follow even the slowest acceleration
};

struct CommissioningConfig {
  AdcConfig<Q30> current{};        ///< offset: counts without current; the gain is not used
  std::int32_t test_counts = 0;    ///< current of the higher level, counts
  std::int32_t rise = 4;           ///< increase of the vector per tick, 2^-20 of the bus
  std::uint32_t settle_ticks = 0;  ///< control ticks until the rotor rests
  LevelStepsConfig steps{};
  HallSurveyConfig hall{};
  std::uint32_t slow_speed = 0;     ///< speed of the field in the slow turn, 2^-32 electrical turns per tick
  std::uint32_t fastest_speed = 0;  ///< largest speed of the field, 2^-32 electrical turns per tick
  std::uint32_t acceleration = 0;   ///< change of the field's speed per tick
  std::uint8_t flux_turns = 16;     ///< electrical turns over which the flux linkage is averaged
  std::uint8_t tries = 4;           ///< attempts at the fast turn
  std::uint32_t timer_ticks = 1;    ///< counts of the capture timer in one control tick
  bool operator==(const CommissioningConfig&) const = default;
};

/// Values of the registers at a tick.
struct CommissioningInput {
  std::uint16_t current_counts[3]{};
  std::uint16_t bus_counts = 0;
  std::uint32_t at = 0;  ///< reading of the capture timer
  std::uint8_t pins = 0;
};

struct CommissioningState {
  CommissioningPhase phase = CommissioningPhase::zeroing;
  CommissioningFault fault = CommissioningFault::none;
  AdcState adc[3]{};
  std::uint32_t ticks = 0;         ///< number of ticks in the present phase
  std::int32_t v = 0;              ///< length of the vector, 2^-20 of the bus
  std::int32_t low = 0, high = 0;  ///< lengths of the vector at the two levels
  BinaryAngle angle = 0;           ///< angle of the vector
  std::int32_t speed = 0;          ///< speed of the vector, 2^-32 turns per tick
  std::uint32_t ticked_at = 0;     ///< reading of the timer at the last tick
  std::uint64_t way = 0;           ///< angle turned at the wanted speed, 2^-32 turns
  std::int8_t direction = 1;
  std::uint8_t tries = 0;
  bool held = false;            ///< true: in phase `spinning` the rotor is fast enough, and the field's speed
                                ///< stays constant
  std::int32_t spin_speed = 0;  ///< the field's constant speed while `held` is true
  LevelStepsState steps{};
  HallSurveyState hall{};
  FluxTurnState turn{};
  LevelStepsReading winding{};
  HallSurveyReading probes{};
  FluxTurnReading magnet{};
};

namespace detail {

inline constexpr std::uint64_t one_turn = std::uint64_t{1} << 32;

constexpr void enter(CommissioningState& state, CommissioningPhase phase) {
  state.phase = phase;
  state.ticks = 0;
  state.way = 0;
}

constexpr void fail(CommissioningState& state, CommissioningFault fault) {
  state.fault = fault;
  enter(state, CommissioningPhase::failed);
}

/// The currents in the frame of the voltage vector, at the vector's angle at the sample instant.
constexpr FieldCurrent current_seen(const CommissioningConfig& config, const CommissioningState& state,
                                    const CommissioningInput& input) {
  std::int32_t eighths[3]{}, signs[3]{};
  for (std::uint8_t k = 0; k < 3; ++k) {
    eighths[k] = std::int32_t{8} * input.current_counts[k] - state.adc[k].offset_eighths;
    signs[k] = eighths[k] < 0 ? -8 : 8;
  }
  const std::int32_t ahead = state.speed * (1 - config.steps.late_half_ticks) / 2;
  const BinaryAngle at = state.angle + static_cast<BinaryAngle>(ahead);
  return {seen_along(eighths, at), seen_along(signs, at)};
}

constexpr void zeroing_tick(const CommissioningConfig& config, CommissioningState& state,
                            const CommissioningInput& input) {
  Calibration last = Calibration::running;
  for (std::uint8_t k = 0; k < 3; ++k) {
    last = adc_calibrate(config.current, state.adc[k], input.current_counts[k]);
    if (last == Calibration::failed) return fail(state, CommissioningFault::offset);
  }
  if (last == Calibration::running) return;
  state.angle = quarter_turn;
  enter(state, CommissioningPhase::rising);
}

constexpr void rising_tick(const CommissioningConfig& config, CommissioningState& state, std::int32_t along) {
  const std::int32_t wanted = 24 * config.test_counts;
  if (state.low == 0 && along >= wanted / 2) state.low = state.v;
  if (along >= wanted) {
    state.high = state.v;
    return enter(state, CommissioningPhase::leaning);
  }
  state.v += config.rise;
  if (state.v > longest_vector) fail(state, CommissioningFault::current);
}

/// Changes the field's speed towards `wanted`. state.way counts only ticks at the speed `wanted`.
constexpr void turn_field(CommissioningState& state, std::int32_t wanted, std::uint32_t acceleration) {
  const auto step = static_cast<std::int32_t>(acceleration);
  const std::int32_t off = wanted - state.speed;
  if (off > step)
    state.speed += step;
  else if (off < -step)
    state.speed -= step;
  else
    state.speed = wanted;
  state.angle += static_cast<BinaryAngle>(state.speed);
  if (state.speed == wanted)
    state.way += static_cast<std::uint64_t>(wanted < 0 ? -static_cast<std::int64_t>(wanted) : wanted);
}

/// One tick of the slow turn. The rotor's oscillation decays during the first turn in each direction. The
/// first recorded code is read at the end of this turn.
constexpr void turning_tick(const CommissioningConfig& config, CommissioningState& state, std::uint8_t pins) {
  const std::uint64_t before = state.way;
  const auto slow = static_cast<std::int32_t>(config.slow_speed);
  turn_field(state, state.direction < 0 ? -slow : slow, config.acceleration);
  if (before < one_turn && state.way >= one_turn) hall_survey_edge(config.hall, state.hall, pins, 0, 0);
  if (state.way < one_turn * (std::uint64_t{config.hall.turns} + 1)) return;
  state.way = 0;
  if (state.direction > 0) {
    state.direction = -1;
    return;
  }
  state.probes = hall_survey_reading(config.hall, state.hall);
  state.direction = 1;
  enter(state, CommissioningPhase::spinning);
}

constexpr std::uint32_t size_of(std::int32_t speed) {
  return static_cast<std::uint32_t>(speed < 0 ? -speed : speed);
}

/// Starts the fast turn again from rest, with a quarter of the acceleration. The caller found that the rotor
/// did not follow the field or is too slow.
constexpr void spin_again(const CommissioningConfig& config, CommissioningState& state) {
  state.turn = FluxTurnState{};
  state.magnet = FluxTurnReading{};
  state.held = false;
  state.speed = 0;
  state.angle = 0;
  if (++state.tries >= config.tries) return fail(state, CommissioningFault::not_turned);
  enter(state, CommissioningPhase::aligning);
}

constexpr void spinning_tick(const CommissioningConfig& config, CommissioningState& state,
                             const FieldCurrent& current, std::uint16_t bus) {
  flux_turn_tick(state.turn, current, bus);
  const BinaryAngle before = state.angle;
  const auto fastest = static_cast<std::int32_t>(config.fastest_speed);
  const std::uint32_t gentle = config.acceleration >> (2 * state.tries);
  turn_field(state, state.held ? state.spin_speed : fastest, gentle == 0 ? 1 : gentle);
  if (state.speed <= 0) state.turn = FluxTurnState{};     // the field still turns backward
  if (state.speed <= 0 || state.angle >= before) return;  // a turn ends where the angle wraps
  const FluxTurnReading turn = flux_turn_reading(state.winding, state.turn, state.v, size_of(state.speed));
  state.turn = FluxTurnState{};
  const bool fast = 2 * turn.emf >= turn.applied || state.speed == fastest;
  if (!state.held && fast) {
    state.held = true;
    state.spin_speed = state.speed;
    state.way = 0;
    return;
  }
  // The rotor's oscillation decays during as many turns as the measurement lasts.
  if (state.held && state.way >= one_turn * config.flux_turns) enter(state, CommissioningPhase::measuring);
}

constexpr void measuring_tick(const CommissioningConfig& config, CommissioningState& state,
                              const FieldCurrent& current, std::uint16_t bus) {
  flux_turn_tick(state.turn, current, bus);
  turn_field(state, state.speed, 0);
  if (state.way < one_turn * config.flux_turns) return;
  const FluxTurnReading reading = flux_turn_reading(state.winding, state.turn, state.v, size_of(state.speed));
  state.turn = FluxTurnState{};
  if (4 * reading.emf < reading.applied) return spin_again(config, state);
  if (state.magnet.flux == 0) {
    state.magnet = reading;
    state.spin_speed -= state.spin_speed / 4;
    return enter(state, CommissioningPhase::spinning);
  }
  // A rotor that slips or oscillates also induces a back-EMF, but this back-EMF is not proportional to the
  // field's speed.
  const std::int32_t off = reading.flux - state.magnet.flux;
  if ((off < 0 ? -off : off) > state.magnet.flux / 32) return spin_again(config, state);
  enter(state, CommissioningPhase::done);
}

constexpr void aligned(CommissioningState& state) {
  if (state.winding.usable) return enter(state, CommissioningPhase::spinning);
  state.v = state.low;
  enter(state, CommissioningPhase::stepping);
}

constexpr void stepping_tick(const CommissioningConfig& config, CommissioningState& state, std::int32_t along,
                             std::uint16_t bus) {
  const bool over = level_steps_tick(config.steps, state.steps, along, bus);
  state.v = state.steps.high ? state.high : state.low;
  if (!over) return;
  state.winding = level_steps_reading(config.steps, state.steps, state.low, state.high);
  if (!state.winding.usable) return fail(state, CommissioningFault::winding);
  state.v = state.high;
  enter(state, CommissioningPhase::turning);
}

constexpr void commissioning_tick(const CommissioningConfig& config, CommissioningState& state,
                                  const CommissioningInput& input) {
  if (state.phase == CommissioningPhase::zeroing) return zeroing_tick(config, state, input);
  const FieldCurrent seen = current_seen(config, state, input);
  ++state.ticks;
  switch (state.phase) {
    case CommissioningPhase::rising:
      return rising_tick(config, state, seen.current.along);
    case CommissioningPhase::leaning:
      if (state.ticks < config.settle_ticks) return;
      state.angle = 0;
      return enter(state, CommissioningPhase::aligning);
    case CommissioningPhase::aligning:
      if (state.ticks >= config.settle_ticks) aligned(state);
      return;
    case CommissioningPhase::stepping:
      return stepping_tick(config, state, seen.current.along, input.bus_counts);
    case CommissioningPhase::turning:
      return turning_tick(config, state, input.pins);
    case CommissioningPhase::spinning:
      return spinning_tick(config, state, seen, input.bus_counts);
    case CommissioningPhase::measuring:
      return measuring_tick(config, state, seen, input.bus_counts);
    default:
      return;
  }
}

}  // namespace detail

}  // namespace sixstep::control
