// SPDX-License-Identifier: Apache-2.0
// Commissioning: the drive measures the motor that is connected to it.
// - Steps of the voltage determine resistance and inductance.
// - A slow turn in each direction determines the table of the Hall lines.
// - A fast turn determines the flux linkage.
// Commissioning needs the data of converters and timer, and the allowed current. It needs no data of the
// motor.
//
//   zeroing    measures the offsets of the three amplifiers, with the bridge off
//   rising     raises a voltage vector until the test current flows. The vector lengths at half of the test
//              current and at the test current are the two levels.
//   leaning    pulls the rotor to a quarter turn. A direct pull to 0 would fail if the rotor rested at half
//              a turn, where the torque is 0.
//   aligning   pulls the rotor to 0, where it rests until the end of the steps
//   stepping   switches between the two levels, to measure R and L (level_steps.hpp)
//   turning    turns the field slowly forward and backward, to record the Hall edges (hall_survey.hpp)
//   spinning   accelerates the rotor until the back-EMF is half of the applied voltage
//   measuring  measures the flux linkage (flux_turn.hpp). Spinning and measuring are repeated at three
//              quarters of the speed. If the two results differ, the rotor did not follow the field. It is
//              then aligned and spun again with a quarter of the acceleration.
//   done, failed
//
// Call commissioning_step once per control tick, and commissioning_hall in the interrupt of the Hall pins.
// The shaft must turn freely, some turns in each direction. commissioning_result.hpp converts the results to
// SI.
#pragma once
#include <cstdint>

#include "sixstep/control/commissioning/commissioning_phases.hpp"

namespace sixstep::control {

/// One control tick; returns the commands of the legs.
template <class Scalar>
constexpr LegCommands<Scalar> commissioning_step(const CommissioningConfig& config, CommissioningState& state,
                                                 const CommissioningInput& input) {
  detail::commissioning_tick(config, state, input);
  state.ticked_at = input.at;
  if (state.phase == CommissioningPhase::zeroing || state.phase >= CommissioningPhase::done)
    return LegCommands<Scalar>{};
  return legs_of_vector<Scalar>(state.v, state.angle);
}

/// The Hall pins changed to `pins` when the timer read `captured`. The function extrapolates the field's
/// angle from the last tick to that instant.
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
