// SPDX-License-Identifier: Apache-2.0
// Where the magnet points, without a sensor of it: from standstill on by what a pulsing voltage makes of the current
// (injection.hpp), at speed by the flux that the magnet makes in the winding (active_flux.hpp). Both tell by how much the magnet is
// ahead of where it is taken to be, and one tracking loop (sensing/tracking.hpp) follows the two, mixed by speed:
//
//   error = (1 - m) e_injection + m e_flux,   m = (|w| - w_low)/(w_high - w_low) within 0..1
//
// Above w_high nothing is injected. How it begins:
//
//   with injection      axis -> north -> following      the rotor is found where it stands, and stays there
//                               '-----> unseen          it does not saturate: the drive gives up
//   by the flux alone   aligning -> ramping -> following    a current turns it: it moves before it is seen
//                           '--------'---------'--> unseen    it was lost too often in a row before it was followed for good
//
// In the second a voltage along an axis holds the rotor, and then a quarter turn on, so that it cannot rest where it is pulled
// neither way; turned on by a steady acceleration it takes the rotor along, up to a speed at which the flux is seen. A rotor that
// falls below w_low is turned again. In floating point.
#pragma once
#include "sixstep/control/field/active_flux.hpp"
#include "sixstep/control/field/injection.hpp"
#include "sixstep/control/field/polarity.hpp"
#include "sixstep/control/leg_command.hpp"
#include "sixstep/control/sensing/sine.hpp"
#include "sixstep/control/sensing/tracking.hpp"

namespace sixstep::control {

enum class EstimatorPhase : std::uint8_t { axis, north, aligning, ramping, following, unseen };

/// A current that turns the rotor before it is seen. The default starts nothing.
template <class Scalar>
struct TurnStartConfig {
  Scalar current_A{};             ///< along the axis
  std::uint32_t align_ticks = 0;  ///< it stands
  std::int64_t step = 0;          ///< by which the speed grows a tick, 2^-48 turn per tick
  std::int64_t enough = 0;        ///< speed at which the flux is followed
  std::uint32_t good_ticks = 0;   ///< a rotor that is followed for so long has started
  std::uint8_t retries = 3;       ///< starts in vain in a row before the drive gives up
  bool operator==(const TurnStartConfig&) const = default;
};

/// The default is not on.
template <class Scalar>
struct EstimatorConfig {
  bool on = false;
  TrackingConfig tracking{};     ///< of the electrical angle
  Gain<Scalar> rad_s{};          ///< mechanical rad/s to a unit of tracking_speed()
  std::uint32_t axis_ticks = 0;  ///< until the axis is followed
  std::uint8_t late = 0;         ///< n: ticks from an answer to the begin of its period
  bool in_middle = false;        ///< a sample lies in the middle of a period: no injection then
  InjectionConfig<Scalar> injection{};
  PolarityConfig<Scalar> north{};
  ActiveFluxConfig<Scalar> flux{};
  TurnStartConfig<Scalar> start{};
  Scalar low_rad_s{}, high_rad_s{};  ///< w_low, w_high, mechanical
  bool operator==(const EstimatorConfig&) const = default;
};

template <class Scalar>
struct EstimatorState {
  EstimatorPhase phase = EstimatorPhase::axis;
  bool begun = false, reversed = false;
  std::uint32_t ticks = 0;
  std::uint8_t failures = 0;  ///< starts in vain, in a row
  TrackingState tracking{};
  BinaryAngle sampled = 0;  ///< that of the last sample, the magnet's
  Scalar speed_rad_s{};     ///< mechanical
  Scalar weight{};          ///< m
  InjectionState<Scalar> injection{};
  NorthState<Scalar> north{};
  ActiveFluxState<Scalar> flux{};
  Dq<Scalar> current{};               ///< of the last sample, in its frame
  AlphaBeta<Scalar> answered_V[4]{};  ///< of the last ticks, the newest first
};

/// Whether a current turns the rotor that is not seen yet.
template <class Scalar>
constexpr bool estimator_turns(const EstimatorState<Scalar>& state) {
  return state.phase == EstimatorPhase::aligning || state.phase == EstimatorPhase::ramping;
}

/// What its own tick asks for along the axis, A.
template <class Scalar>
constexpr Scalar estimator_reference_d(const EstimatorConfig<Scalar>& config,
                                       const EstimatorState<Scalar>& state) {
  if (state.phase == EstimatorPhase::north) return north_current(config.north, state.north);
  return estimator_turns(state) ? config.start.current_A : Scalar{};
}

template <class Scalar>
constexpr bool estimator_injects(const EstimatorConfig<Scalar>& config, const EstimatorState<Scalar>& state) {
  return config.injection.voltage_V > Scalar{} && state.phase != EstimatorPhase::unseen &&
         state.weight < one<Scalar>;
}

namespace detail {

template <class Scalar>
constexpr void estimator_begin(const EstimatorConfig<Scalar>& config, EstimatorState<Scalar>& state,
                               bool reversed) {
  state.begun = true;
  state.reversed = reversed;
  state.ticks = 0;
  state.tracking = {};
  state.phase = config.injection.voltage_V > Scalar{} ? EstimatorPhase::axis : EstimatorPhase::aligning;
  state.flux.flux = {config.flux.magnet_Vs, Scalar{}};
}

/// Mean from the last sample to this one, V.
template <class Scalar>
constexpr AlphaBeta<Scalar> mean_voltage(const EstimatorConfig<Scalar>& config,
                                         const EstimatorState<Scalar>& state) {
  const AlphaBeta<Scalar>& last = state.answered_V[config.late];
  if (!config.in_middle) return last;
  const AlphaBeta<Scalar>& before = state.answered_V[config.late + 1];
  return {ScalarTraits<Scalar>::half_difference(last.alpha, -before.alpha),
          ScalarTraits<Scalar>::half_difference(last.beta, -before.beta)};
}

template <class Scalar>
constexpr Scalar flux_weight(const EstimatorConfig<Scalar>& config, Scalar speed_rad_s) {
  if (!(config.flux.magnet_Vs > Scalar{})) return Scalar{};
  if (!(config.injection.voltage_V > Scalar{})) return one<Scalar>;
  const Scalar past = magnitude(speed_rad_s) - config.low_rad_s, wide = config.high_rad_s - config.low_rad_s;
  return past >= wide ? one<Scalar> : past > Scalar{} ? past / wide : Scalar{};
}

/// The other end is north: what was told in the frame is told in the one half a turn on.
template <class Scalar>
constexpr void turn_round(EstimatorState<Scalar>& state) {
  state.tracking.angle += half_turn;
  state.current = {-state.current.d, -state.current.q};
}

/// A current turns on, and the angle with it, at whatever the rotor does.
template <class Scalar>
constexpr void turn_on(const EstimatorConfig<Scalar>& config, EstimatorState<Scalar>& state) {
  const TurnStartConfig<Scalar>& start = config.start;
  TrackingState& t = state.tracking;
  if (state.phase == EstimatorPhase::aligning) {
    if (++state.ticks == start.align_ticks / 2) t.angle += quarter_turn;
    if (state.ticks >= start.align_ticks) state.phase = EstimatorPhase::ramping;
    return;
  }
  t.speed += state.reversed ? -start.step : start.step;
  t.angle += static_cast<std::uint32_t>(shifted_down(t.speed, 16));
  if ((state.reversed ? -t.speed : t.speed) < start.enough) return;
  state.phase = EstimatorPhase::following;
  state.ticks = 0;
}

template <class Scalar>
constexpr void find_north(const EstimatorConfig<Scalar>& config, EstimatorState<Scalar>& state, Scalar h_d) {
  if (state.phase == EstimatorPhase::axis) {
    if (++state.ticks >= config.axis_ticks) state.phase = EstimatorPhase::north;
    return;
  }
  if (state.phase != EstimatorPhase::north) return;
  north_step(config.north, state.north, h_d);
  if (state.north.phase == NorthPhase::unseen) state.phase = EstimatorPhase::unseen;
  if (state.north.phase == NorthPhase::opposite) turn_round(state);
  if (state.north.phase != NorthPhase::opposite && state.north.phase != NorthPhase::found) return;
  state.phase = EstimatorPhase::following;
  // The pull has had no north yet.
  const Direction<Scalar> magnet = direction_of<Scalar>(state.tracking.angle);
  state.flux.flux = {config.flux.magnet_Vs * magnet.cos + config.flux.L_q_H * state.flux.current.alpha,
                     config.flux.magnet_Vs * magnet.sin + config.flux.L_q_H * state.flux.current.beta};
}

/// Whether the flux is all there is to follow, and the rotor too slow for it.
template <class Scalar>
constexpr bool out_of_sight(const EstimatorConfig<Scalar>& config, const EstimatorState<Scalar>& state) {
  return state.phase == EstimatorPhase::following && !(config.injection.voltage_V > Scalar{}) &&
         magnitude(state.speed_rad_s) < config.low_rad_s;
}

/// A rotor that is turned is begun with anew where it is lost. One that was not asked to turn so fast that it is seen was not lost in vain.
template <class Scalar>
constexpr void look_for_it(const EstimatorConfig<Scalar>& config, EstimatorState<Scalar>& state,
                           bool reversed, bool turns) {
  if (!out_of_sight(config, state)) {
    if (state.phase == EstimatorPhase::following && state.ticks < config.start.good_ticks) ++state.ticks;
    return;
  }
  const bool in_vain = turns && state.ticks < config.start.good_ticks;
  state.failures = in_vain ? static_cast<std::uint8_t>(state.failures + 1) : std::uint8_t{0};
  if (state.failures > config.start.retries)
    state.phase = EstimatorPhase::unseen;
  else
    estimator_begin(config, state, reversed);
}

}  // namespace detail

/// One control tick with its currents: those in the frame of the magnet as it is taken to point, A, free of the pulse.
/// reversed: which way a rotor is turned that has to be turned to be seen; turns: whether it is asked to turn fast enough for that.
template <class Scalar>
constexpr Dq<Scalar> estimator_step(const EstimatorConfig<Scalar>& config, EstimatorState<Scalar>& state,
                                    const AlphaBeta<Scalar>& current, bool reversed, bool turns) {
  using T = ScalarTraits<Scalar>;
  if (!state.begun) detail::estimator_begin(config, state, reversed);
  detail::look_for_it(config, state, reversed, turns);
  state.sampled = state.tracking.angle;
  const Direction<Scalar> axis = direction_of<Scalar>(state.sampled);
  const bool pulsed = detail::pulsed_twice(state.injection.pulses, config.late);
  const Dq<Scalar> h = injection_response(state.injection, current, config.late);
  const Scalar ahead =
      active_flux_step(config.flux, state.flux, detail::mean_voltage(config, state), current, axis);
  const Dq<Scalar> last = state.current;
  state.current = park(current, axis);
  const Dq<Scalar> mean = pulsed ? Dq<Scalar>{T::half_difference(state.current.d, -last.d),
                                              T::half_difference(state.current.q, -last.q)}
                                 : state.current;
  if (estimator_turns(state)) {
    detail::turn_on(config, state);
  } else {
    const Scalar by_pulse = T::product(h.q, config.injection.rad_per_A);
    const Scalar error = by_pulse + state.weight * (ahead - by_pulse);
    tracking_step(config.tracking, state.tracking, angle_of_rad(error));
    detail::find_north(config, state, h.d);
  }
  state.speed_rad_s = tracked_speed<Scalar>(state.tracking, config.rad_s);
  state.weight =
      state.phase == EstimatorPhase::following ? detail::flux_weight(config, state.speed_rad_s) : Scalar{};
  return mean;
}

/// The voltages of the tick's answer, as the timer is told them: of what it cannot do it does the nearest.
template <class Scalar>
constexpr void estimator_answered(EstimatorState<Scalar>& state, const LegCommands<Scalar>& command,
                                  Scalar bus_V) {
  for (std::uint8_t n = 3; n > 0; --n) state.answered_V[n] = state.answered_V[n - 1];
  const AlphaBeta<Scalar> part =
      clarke(Abc<Scalar>{command.leg[0].duty, command.leg[1].duty, command.leg[2].duty});
  state.answered_V[0] = {part.alpha * bus_V, part.beta * bus_V};
}

}  // namespace sixstep::control
