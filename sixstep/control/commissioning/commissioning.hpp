// SPDX-License-Identifier: Apache-2.0
// Commissioning: the drive measures the motor that is connected to it. Steps give resistance and inductance. A
// slow turn each way gives the table of the Hall lines, and a fast turn gives the flux linkage. The data of
// converters and timer and the allowed current are required, but no data of the motor.
//
//   zeroing    measures the offsets of the three amplifiers, the bridge off
//   rising     raises a vector until the test current flows; it and that of half the current are the two levels
//   leaning    pulls the rotor to a quarter turn, so that no dead point is left
//   aligning   pulls it to 0, where it rests until the end of the steps
//   stepping   level_steps.hpp
//   turning    hall_survey.hpp, forward and backward
//   spinning   accelerates it until the back-EMF is half of the vector
//   measuring  flux_turn.hpp; then spinning and measuring again at three quarters of the speed: if the two differ the
//              rotor was lost, and is aligned and spun again, with a quarter of the acceleration
//   done, failed
//
// Call commissioning_step once per control tick, and commissioning_hall in the interrupt of the Hall pins. The
// shaft must turn freely, some turns each way. commissioning_result.hpp gives the results in SI.
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

/// The Hall pins changed, at a reading of the timer. The field's angle is extrapolated from the last tick.
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
