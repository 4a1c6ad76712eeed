// SPDX-License-Identifier: Apache-2.0
// Limits the current reference, and turns all gates off where a smaller reference is not sufficient.
//
// Each limit reduces the window of allowed current references i (K, g: slopes, w: speed, U_s: bus voltage):
//
//   current       |i| <= limit
//   torque        |i| <= T_limit/K_t                                (model.md 1: T_e = K_t i_m)
//   speed         i <= K (w_limit - w) forward, i >= -K (w_limit + w) backward, both at least 0 A
//   regeneration  braking current <= g (U_limit - U_s), at least 0 A
//
// Regeneration: while the motor brakes (i w < 0), the bridge returns current to the bus. If the supply cannot
// absorb this current, it charges the bus capacitor C: C dU/dt <= |i|. With |i| <= g (U_limit - U) the
// distance from U to U_limit decays at most as fast as exp(-g t/C), if a tick is short compared with C/g.
//
// A reference of 0 is not sufficient, for two reasons. First, a loop that controls the sampled valley of a
// chopped current to 0 has a mean above 0. Second, reversed pulses that begin and end between two samples are
// not measured. Beyond a limit all gates are therefore off until the next sample, for any chopping and
// current loop:
//
//   current       a phase above 5/4 of the limit
//   speed         |w| above the limit, and the reference does not brake
//   regeneration  U_s above the limit, and the reference does not drive
//
// With all gates off the currents fall, as long as the bus voltage is above the back-EMF. Current, speed and
// bus voltage therefore exceed a limit by at most their change in one control period
// (design/loops/limit_bounds.hpp). Faults (faults.hpp) are the second protection.
#pragma once
#include "sixstep/control/bridge_command.hpp"
#include "sixstep/control/fixed.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

/// Default: no current is allowed. The limits of speed and regeneration are off until their flags are set.
template <class Scalar>
struct LimitsConfig {
  Scalar current_A{};  ///< A; the lesser of torque limit/K_t and the thermal limit; in fixed point below 0.8
  bool limits_speed = false;
  Scalar speed_rad_s{};        ///< largest |w| to which the drive may accelerate
  Gain<Scalar> A_per_rad_s{};  ///< K: full current is allowed up to current_A/K below the speed limit
  bool limits_regeneration = false;
  Scalar bus_V{};          ///< U_limit, largest bus voltage
  Gain<Scalar> A_per_V{};  ///< g: full braking current is allowed up to current_A/g below the limit
  bool operator==(const LimitsConfig&) const = default;
};

/// The window of allowed current references, A; low <= 0 <= high.
template <class Scalar>
struct CurrentWindow {
  Scalar low{}, high{};
};

/// Converts a torque limit, N m, to a current limit, A.
template <class Scalar>
constexpr Scalar current_of_torque(Scalar torque_Nm, Gain<Scalar> A_per_Nm) {
  return ScalarTraits<Scalar>::product(torque_Nm, A_per_Nm);
}

namespace detail {
/// The current allowed at a distance `room` from a limit: per_room times room, clamped to 0..most.
template <class Scalar>
constexpr Scalar folded_back(Scalar room, Gain<Scalar> per_room, Scalar most) {
  return room > Scalar{} ? between(ScalarTraits<Scalar>::product(room, per_room), Scalar{}, most) : Scalar{};
}
}  // namespace detail

template <class Scalar>
constexpr CurrentWindow<Scalar> current_window(const LimitsConfig<Scalar>& config, Scalar speed_rad_s,
                                               Scalar bus_V) {
  CurrentWindow<Scalar> window{-config.current_A, config.current_A};
  if (config.limits_speed) {
    window.high = detail::folded_back(config.speed_rad_s - speed_rad_s, config.A_per_rad_s, window.high);
    window.low = -detail::folded_back(config.speed_rad_s + speed_rad_s, config.A_per_rad_s, -window.low);
  }
  if (config.limits_regeneration) {
    const Scalar braking = detail::folded_back(config.bus_V - bus_V, config.A_per_V, config.current_A);
    if (speed_rad_s > Scalar{} && window.low < -braking) window.low = -braking;
    if (speed_rad_s < Scalar{} && window.high > braking) window.high = braking;
  }
  return window;
}

/// True if a sampled phase current exceeds 5/4 of the limit. With references within the limit, ripple and
/// overshoot stay below 5/4.
template <class Scalar>
constexpr bool over_limit(const LimitsConfig<Scalar>& config, const Measurement<Scalar>& m) {
  constexpr Gain<Scalar> five_quarters(1.25);
  const Scalar most = ScalarTraits<Scalar>::product(config.current_A, five_quarters);
  return magnitude(m.i_a_A) > most || magnitude(m.i_b_A) > most || magnitude(m.i_c_A) > most;
}

/// True if speed or bus voltage exceeds its limit and the current `reference_A` does not reduce this excess.
template <class Scalar>
constexpr bool must_coast(const LimitsConfig<Scalar>& config, Scalar reference_A, Scalar speed_rad_s,
                          Scalar bus_V) {
  const Scalar along = speed_rad_s < Scalar{} ? -reference_A : reference_A;
  if (config.limits_speed && magnitude(speed_rad_s) > config.speed_rad_s && !(along < Scalar{})) return true;
  return config.limits_regeneration && bus_V > config.bus_V && speed_rad_s != Scalar{} && !(along > Scalar{});
}

}  // namespace sixstep::control
