// SPDX-License-Identifier: Apache-2.0
// Limits of the current reference: a window that each limit narrows.
//
//   current       |i| <= limit
//   torque        |i| <= T_limit/K_t                                (MODEL 1: T_e = K_t i_m)
//   speed         i <= K (w_limit - w) forward, i >= -K (w_limit + w) backward, both at least 0 A
//   regeneration  braking current <= g (U_limit - U_s), at least 0 A
//
// Regeneration: braking, i w < 0, the bridge returns current to the bus, and where the supply cannot take it,
// the bus rises: C dU/dt <= |i|. With |i| <= g (U_limit - U) it comes to rest below U_limit, as
// exp(-g t/C), for a tick short against C/g. At the limit the drive does not brake at all: it coasts.
// A fault (faults.hpp) stands behind these: they shape a reference, the current follows by its loop.
#pragma once
#include "sixstep/control/fixed.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

/// Defaults allow no current; what is not wanted is switched off by its flag.
template <class Scalar>
struct LimitsConfig {
  Scalar current_A{};  ///< torque limit/K_t and the thermal limit, whichever is less
  bool limits_speed = false;
  Scalar speed_rad_s{};        ///< never to be passed by own torque
  Gain<Scalar> A_per_rad_s{};  ///< K: full current down to current_A/K below the limit
  bool limits_regeneration = false;
  Scalar bus_V{};          ///< U_limit
  Gain<Scalar> A_per_V{};  ///< g: full braking current down to current_A/g below the limit
};

/// The references that are allowed, low <= 0 <= high.
template <class Scalar>
struct CurrentWindow {
  Scalar low{}, high{};
};

/// Torque limit in N m -> current limit in A.
template <class Scalar>
constexpr Scalar current_of_torque(Scalar torque_Nm, Gain<Scalar> A_per_Nm) {
  return ScalarTraits<Scalar>::product(torque_Nm, A_per_Nm);
}

namespace detail {
/// K room, between 0 and most.
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

}  // namespace sixstep::control
