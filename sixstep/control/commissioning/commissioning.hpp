// SPDX-License-Identifier: Apache-2.0
// A drive that finds out what hangs at it: resistance and inductance by steps, the table of the Hall lines by a slow turn
// each way, the flux linkage by a fast one. It knows its converters, its timer and how much current it may make; of the
// motor nothing.
//
//   zeroing    offsets of the three amplifiers, the bridge off
//   rising     a vector grows until the current is there: it and the one of half the current are the two levels
//   leaning    the rotor is pulled to a quarter turn, so that no dead point is left
//   aligning   and to 0: from here to the steps' end it rests
//   stepping   level_steps.hpp
//   turning    hall_survey.hpp, forward and backward
//   spinning   ever faster until the back-EMF is half of the vector
//   measuring  flux_turn.hpp, and spinning and measuring again at three quarters of the speed: where the two differ the
//              rotor had been lost, and is aligned and spun again, a quarter as fast
//   done, failed
//
// Call commissioning_step once per control tick, and commissioning_hall in the interrupt of the Hall pins. The shaft turns
// freely meanwhile, some turns each way. What was found, in SI: commissioning_result.hpp.
#pragma once
#include <cstdint>

#include "sixstep/control/commissioning/commissioning_phases.hpp"

namespace sixstep::control {

/// One control tick.
template <class Scalar>
constexpr LegCommands<Scalar> commissioning_step(const CommissioningConfig& config, CommissioningState& state,
                                                 const CommissioningInput& input) {
  detail::commissioning_tick(config, state, input);
  state.ticked_at = input.at;
  if (state.phase == CommissioningPhase::zeroing || state.phase >= CommissioningPhase::done)
    return LegCommands<Scalar>{};
  return legs_of_vector<Scalar>(state.v, state.angle);
}

/// The Hall pins changed, at a reading of the timer: the field has gone on since the tick.
constexpr void commissioning_hall(const CommissioningConfig& config, CommissioningState& state,
                                  std::uint8_t pins, std::uint32_t captured) {
  if (state.phase != CommissioningPhase::turning || state.way < detail::one_turn) return;
  const std::int64_t since = static_cast<std::int32_t>(captured - state.ticked_at);
  const std::int64_t half_ticks = detail::ratio_of(2 * since * state.speed, config.timer_ticks) -
                                  std::int64_t{state.speed} * (config.steps.late_half_ticks + 1);
  hall_survey_edge(config.hall, state.hall, pins, state.direction,
                   state.angle + static_cast<BinaryAngle>(half_ticks / 2));
}

}  // namespace sixstep::control
