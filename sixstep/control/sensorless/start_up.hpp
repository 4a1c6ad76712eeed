// SPDX-License-Identifier: Apache-2.0
// Starts the motor from standstill, until zero crossings are reliable: alignment, then a ramp.
//
// Alignment. The pair of sector s pulls the rotor to the angle at which the pair's torque is 0: 60 (s + 2)
// degrees, forward. At the opposite angle the torque is 0 too. Therefore a second pair, one sector further,
// follows: its torque at the opposite angle is not 0.
//
// The rotor swings about its final angle with the frequency sqrt(p K_t I/J), with pole pairs p, torque
// constant K_t, current I and inertia J. Only friction damps this swing, because the pair's back-EMF is 0 at
// this angle. The floating leg's voltage, however, is proportional to the speed of the swing. While this
// speed grows, the rotor moves towards the final angle, and the current is low. While the speed falls, the
// rotor moves away from the final angle, against the full current. Each half swing therefore reduces the
// energy by the ratio of the two currents.
//
// Ramp. The pair two sectors further then drives the rotor. The field turns as a function of time,
//
//   w(t) = a t  (+ j t^2/2),    speed w, acceleration a, jerk j; a commutation each 60 degrees
//
// but only until the back-EMF shows a crossing.
// - If a crossing is found, the next commutation follows half a sector later.
// - If a crossing is still expected, the drive waits for it, up to a whole sector.
// - If a crossing had passed before it could be detected, the drive commutates at once. This applies to the
//   second consecutive such sector, or after two detected crossings.
#pragma once
#include <cstdint>

#include "sixstep/control/sensorless/commutation_clock.hpp"
#include "sixstep/control/sensorless/zero_crossing.hpp"

namespace sixstep::control {

/// Default: the drive does not start. The ramp is counted in control ticks; 2^32 is one sector.
template <class Scalar>
struct StartUpConfig {
  Scalar current_A{};                ///< current of the pair during alignment and ramp
  Scalar falling_A{};                ///< current of the alignment while the swing's speed grows
  std::uint32_t align_ticks = 0;     ///< duration of each of the two alignment steps, ticks of the timer
  std::uint8_t swing_shift = 4;      ///< 2^n control ticks: time constant of the swing's mean
  std::int32_t swing_threshold = 0;  ///< counts of y above which y counts as a swing, not as noise
  std::uint32_t first_speed = 0;     ///< speed at the begin of the ramp, 2^-32 sectors per control tick
  std::uint32_t acceleration = 0;    ///< increase of the speed per tick, 2^-32 sectors per tick
  std::uint32_t jerk = 0;            ///< increase of the acceleration per tick, in 2^-48 sectors per tick^2;
                                     ///< the sum of the increases is at most 65535 units of `acceleration`
  std::uint32_t last_speed = 0;      ///< speed at the end of the ramp, 2^-32 sectors per tick
  std::uint32_t longest_ticks = 0;   ///< longest duration of the ramp, ticks of the timer
  std::uint8_t trusted = 6;          ///< consecutive found crossings at which the ramp ends
  /// Longest sector at which the ramp may end, ticks of the timer: the sector at 5 % of rated speed.
  std::uint32_t trusted_ticks = 0;
  bool operator==(const StartUpConfig&) const = default;
};

struct StartUpState {
  std::uint32_t since = 0;   ///< begin of the alignment step or of the ramp
  std::uint8_t step = 0;     ///< step of the alignment
  std::int32_t swing = 0;    ///< mean of |y|, multiplied by 2^swing_shift
  bool falls = false;        ///< true: the swing's speed grows, and falling_A applies
  std::uint32_t angle = 0;   ///< angle of the field within its sector, 2^-32 sectors
  std::uint32_t speed = 0;   ///< speed of the field, 2^-32 sectors per tick
  std::uint32_t faster = 0;  ///< increase of the acceleration by the jerk, in 1/65536 of the unit of
                             ///< `acceleration`
  std::uint16_t ticks = 0;   ///< control ticks in the present sector
  std::uint8_t waited = 0;   ///< number of whole sectors for which the ramp has waited for a crossing
  std::uint8_t trusted = 0;  ///< consecutive found crossings
  std::uint8_t passed = 0;   ///< consecutive sectors whose crossing had passed before it could be detected
};

constexpr void align_begin(StartUpState& state, std::uint32_t now) {
  state = StartUpState{};
  state.since = now;
}

/// Measures the swing by the floating leg's y. Call it once per control tick.
template <class Scalar>
constexpr void align_swing(const StartUpConfig<Scalar>& config, StartUpState& state,
                           const CrossingReading& seen) {
  if (!seen.visible) return;
  const std::int32_t size = seen.y < 0 ? -seen.y : seen.y;
  const std::int32_t mean = state.swing / static_cast<std::int32_t>(std::int32_t{1} << config.swing_shift);
  state.falls = size > config.swing_threshold && size > mean;
  state.swing += size - mean;
}

/// True at the end of an alignment step; the alignment ends with the second step.
template <class Scalar>
constexpr bool align_step_ends(const StartUpConfig<Scalar>& config, StartUpState& state, std::uint32_t now) {
  if (static_cast<std::uint32_t>(now - state.since) < config.align_ticks) return false;
  const std::uint8_t step = static_cast<std::uint8_t>(state.step + 1);
  align_begin(state, now);
  state.step = step;
  return true;
}

template <class Scalar>
constexpr void ramp_begin(const StartUpConfig<Scalar>& config, StartUpState& state, std::uint32_t now) {
  state = StartUpState{};
  state.since = now;
  state.speed = config.first_speed;
}

/// Begins a sector of the ramp.
constexpr void ramp_commutated(StartUpState& state) {
  state.angle = 0;
  state.ticks = 0;
  state.waited = 0;
}

namespace detail {

/// Advances speed and angle of the field by a tick. Returns true if the field has turned by a sector.
template <class Scalar>
constexpr bool ramp_turns(const StartUpConfig<Scalar>& config, StartUpState& state) {
  const std::uint32_t acceleration = config.acceleration + (state.faster >> 16);
  state.faster = state.faster + config.jerk < state.faster ? 0xffffffffu : state.faster + config.jerk;
  if (state.speed < config.last_speed)
    state.speed =
        config.last_speed - state.speed > acceleration ? state.speed + acceleration : config.last_speed;
  const std::uint32_t before = state.angle;
  state.angle += state.speed;
  if (state.ticks < 0xffff) ++state.ticks;
  return state.angle < before;
}

}  // namespace detail

/// One control tick of the ramp. Returns true if the drive must commutate now because the field has turned by
/// a sector, or because the crossing had already passed. `scheduled`: a crossing that was found has scheduled
/// the commutation.
template <class Scalar>
constexpr bool ramp_step(const StartUpConfig<Scalar>& config, StartUpState& state,
                         const CrossingReading& reading, bool waits_for_crossing, bool scheduled) {
  const bool turned = detail::ramp_turns(config, state);
  if (reading.crossing == Crossing::seen) {
    state.passed = 0;
    if (state.trusted < 255) ++state.trusted;
    // The field continues at the measured speed: half a sector divided by the time since the commutation.
    const std::uint32_t seen =
        0x80000000u / (state.ticks == 0 ? 1u : static_cast<std::uint32_t>(state.ticks));
    if (seen > state.speed) state.speed = seen < config.last_speed ? seen : config.last_speed;
    return false;
  }
  if (scheduled) return false;
  if (reading.crossing == Crossing::passed_before) {
    if (state.passed < 255) ++state.passed;
    if (state.passed > 1 || state.trusted > 1) {
      state.trusted = 0;
      return true;
    }
    state.trusted = 0;
  }
  if (!turned) return false;
  if (waits_for_crossing && state.waited < 1) {
    ++state.waited;
    return false;
  }
  state.trusted = 0;
  return true;
}

}  // namespace sixstep::control
