// SPDX-License-Identifier: Apache-2.0
// Feeds the back-EMF and the measured bus voltage forward, to reduce the error that the current loop must
// correct.
//
//   u = u_PI + K_t w          plus the back-EMF K_t w between the driven terminals on flat tops (model.md 1)
//   d = u/U_s                 duty from the measured instead of the nominal bus voltage U_s (model.md 4)
#pragma once
#include "sixstep/control/fixed.hpp"
#include "sixstep/control/scalar.hpp"

namespace sixstep::control {

/// Default: no voltage is added.
template <class Scalar>
struct FeedForwardConfig {
  Gain<Scalar> K_t_V_s{};  ///< V between the driven terminals per mechanical rad/s; equals the torque
                           ///< constant in N m/A
  bool operator==(const FeedForwardConfig&) const = default;
};

template <class Scalar>
constexpr Scalar back_emf_voltage(const FeedForwardConfig<Scalar>& config, Scalar speed_rad_s) {
  return ScalarTraits<Scalar>::product(speed_rad_s, config.K_t_V_s);
}

/// Default: the measured bus voltage is not used.
template <class Scalar>
struct BusCompensationConfig {
  Scalar lowest_bus_V{};  ///< least divisor, V; replaces a lower measurement, for example of a failed sensor;
                          ///< 0: off
  bool operator==(const BusCompensationConfig&) const = default;
};

/// Duty -1..1 for a voltage between the driven terminals.
template <class Scalar>
constexpr Scalar compensated_duty(const BusCompensationConfig<Scalar>& config, Scalar voltage_V,
                                  Scalar bus_V) {
  const Scalar bus = bus_V < config.lowest_bus_V ? config.lowest_bus_V : bus_V;
  return clamped(voltage_V / bus, one<Scalar>);
}

}  // namespace sixstep::control
