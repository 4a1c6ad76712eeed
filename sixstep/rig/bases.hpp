// SPDX-License-Identifier: Apache-2.0
// Converts between SI units and the controller's numbers: floating point uses SI units, fixed point uses
// numbers relative to a base.
#pragma once
#include <type_traits>

namespace sixstep::rig {

/// SI values of the controller's number 1.0 (design::Bases). For floating point all bases are 1.
struct Bases {
  double current_A = 1.0;
  double voltage_V = 1.0;
  double speed_rad_s = 1.0;
  double position_deg = 1.0;
  double setpoint = 1.0;  ///< base of the mode's setpoint: one of the four bases above; 1 for a duty
};

/// Converts SI to a number of the controller. Fixed point rounds to nearest and saturates (fixed.hpp).
template <class Scalar, class Real>
Scalar from_si(Real x, double unit) {
  if constexpr (std::is_arithmetic_v<Scalar>)
    return static_cast<Scalar>(x);
  else
    return Scalar(static_cast<double>(x) / unit);
}

/// Converts a number of the controller to SI.
template <class Scalar>
double to_si(Scalar x, double unit) {
  if constexpr (std::is_arithmetic_v<Scalar>)
    return static_cast<double>(x);
  else
    return static_cast<double>(x) * unit;
}

}  // namespace sixstep::rig
