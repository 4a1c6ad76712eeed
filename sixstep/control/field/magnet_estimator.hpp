// SPDX-License-Identifier: Apache-2.0
// Estimates the direction of the magnet without a sensor. At standstill and low speed it uses the current's
// response to a pulsing voltage (injection.hpp). At higher speed it uses the magnet's flux in the winding
// (active_flux.hpp). The error of the estimate is the angle by which the magnet is ahead of the estimate.
// Each method measures this error. One tracking loop (sensing/tracking.hpp) follows the mean of both errors,
// weighted by speed:
//
//   error = (1 - m) e_injection + m e_flux,   m = (|w| - w_low)/(w_high - w_low) within 0..1
//
// w is the speed. Above w_high no voltage is injected. The phases of the start:
//
//   with injection      axis -> north -> following      the magnet is found while the rotor is at rest
//                                '-----> unseen         the iron does not saturate: the drive stops
//   without injection   aligning -> ramping -> following     at first a current vector turns the rotor
//                            '--------'---------'--> unseen  too many consecutive failed starts
//
// Without injection, a voltage along an axis pulls the rotor, then a voltage a quarter turn ahead of this
// axis. With the first voltage only, the rotor could rest opposite to the axis, where the torque is 0. Then a
// current vector turns with constant acceleration, up to a speed at which the flux can be followed. A rotor
// that becomes slower than w_low is started again. The estimator exists in floating point only.
#pragma once
#include "sixstep/control/field/active_flux.hpp"
#include "sixstep/control/field/injection.hpp"
#include "sixstep/control/field/polarity.hpp"
#include "sixstep/control/leg_command.hpp"
#include "sixstep/control/sensing/sine.hpp"
#include "sixstep/control/sensing/tracking.hpp"

namespace sixstep::control {

enum class EstimatorPhase : std::uint8_t { axis, north, aligning, ramping, following, unseen };

/// Start by a turning current vector that moves the rotor until the estimator can follow it. Default: no
/// start.
template <class Scalar>
struct TurnStartConfig {
  Scalar current_A{};             ///< current along the vector
  std::uint32_t align_ticks = 0;  ///< duration of the alignment
  std::int64_t step = 0;          ///< increase of the speed per tick, 2^-48 electrical turns per tick
  std::int64_t enough = 0;        ///< speed from which the flux is followed, 2^-48 electrical turns per tick
  std::uint32_t good_ticks = 0;   ///< ticks in phase `following` after which the start counts as successful
  std::uint8_t retries = 3;       ///< number of consecutive failed starts after which the drive stops at the
                                  ///< next failure
  bool operator==(const TurnStartConfig&) const = default;
};

/// Default: off.
template <class Scalar>
struct EstimatorConfig {
  bool on = false;
  TrackingConfig tracking{};     ///< tracking loop of the electrical angle
  Gain<Scalar> rad_s{};          ///< mechanical rad/s per unit of tracking_speed()
  std::uint32_t axis_ticks = 0;  ///< ticks after the begin until the axis counts as found
  std::uint8_t late = 0;         ///< n: ticks from an output to the begin of its period
  bool in_middle = false;        ///< true: samples are in the middle of a period, so that injection is not
                                 ///< possible
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
  std::uint8_t failures = 0;  ///< consecutive failed starts
  TrackingState tracking{};
  BinaryAngle sampled = 0;  ///< the magnet's angle at the last sample
  Scalar speed_rad_s{};     ///< mechanical
  Scalar weight{};          ///< m, weight of the flux in the error
  InjectionState<Scalar> injection{};
  NorthState<Scalar> north{};
  ActiveFluxState<Scalar> flux{};
  Dq<Scalar> current{};               ///< current at the last sample, A, in the frame at that sample
  AlphaBeta<Scalar> answered_V[4]{};  ///< voltages of the last ticks' outputs, V, newest first
};

/// True while the start's current vector turns the rotor, before the estimator follows it.
template <class Scalar>
constexpr bool estimator_turns(const EstimatorState<Scalar>& state) {
  return state.phase == EstimatorPhase::aligning || state.phase == EstimatorPhase::ramping;
}

/// Reference of the current along the axis, A, in the phases in which the estimator determines the current.
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

/// Mean voltage from the last sample to the present sample, V.
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

/// Rotates the estimated frame and the stored current by half a turn, because north is the opposite end of
/// the axis.
template <class Scalar>
constexpr void turn_round(EstimatorState<Scalar>& state) {
  state.tracking.angle += half_turn;
  state.current = {-state.current.d, -state.current.q};
}

/// Rotates the current vector of the start and sets the estimate equal to its angle. The rotor's real angle
/// has no influence.
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
  // Replaces the flux, because it was estimated before north was found.
  const Direction<Scalar> magnet = direction_of<Scalar>(state.tracking.angle);
  state.flux.flux = {config.flux.magnet_Vs * magnet.cos + config.flux.L_q_H * state.flux.current.alpha,
                     config.flux.magnet_Vs * magnet.sin + config.flux.L_q_H * state.flux.current.beta};
}

/// True if nothing is injected and the rotor is too slow to follow its flux.
template <class Scalar>
constexpr bool out_of_sight(const EstimatorConfig<Scalar>& config, const EstimatorState<Scalar>& state) {
  return state.phase == EstimatorPhase::following && !(config.injection.voltage_V > Scalar{}) &&
         magnitude(state.speed_rad_s) < config.low_rad_s;
}

/// Starts the rotor again if the estimator cannot follow it. This counts as a failed start only if the
/// setpoint requires a speed at which the flux can be followed.
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

/// One control tick with its currents. Returns the currents in the estimated magnet's frame, A, without the
/// current of the pulse. `reversed`: a start turns the rotor backward. `turns`: the setpoint requires a speed
/// at which the rotor can be followed.
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

/// Stores the voltage of the tick's output, computed from the clamped duties that the timer receives.
template <class Scalar>
constexpr void estimator_answered(EstimatorState<Scalar>& state, const LegCommands<Scalar>& command,
                                  Scalar bus_V) {
  for (std::uint8_t n = 3; n > 0; --n) state.answered_V[n] = state.answered_V[n - 1];
  const AlphaBeta<Scalar> part =
      clarke(Abc<Scalar>{command.leg[0].duty, command.leg[1].duty, command.leg[2].duty});
  state.answered_V[0] = {part.alpha * bus_V, part.beta * bus_V};
}

}  // namespace sixstep::control
