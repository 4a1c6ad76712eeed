// SPDX-License-Identifier: Apache-2.0
// The scalars for typed tests of control blocks, and their resolution.
#pragma once
#include <gtest/gtest.h>

#include <limits>
#include <type_traits>

#include "sixstep/control/pi.hpp"

namespace sixstep::control {

using Scalars = ::testing::Types<double, float, Q14, Q30>;

/// The scalars, including the types whose largest number is below 1. A decoder's result may be 1: at half a
/// turn, or at the peak of the sine.
using SensingScalars = ::testing::Types<double, float, Q15, Q14, Q31, Q30>;

template <class Scalar>
constexpr bool is_fixed = !std::is_floating_point_v<Scalar>;

/// The distance between neighbouring numbers around 1.
template <class Scalar>
constexpr double digit() {
  if constexpr (is_fixed<Scalar>)
    return static_cast<double>(Scalar::from_raw(1));
  else
    return std::numeric_limits<Scalar>::epsilon();
}

/// A gain from counts to signals: raw digits in fixed point.
template <class Scalar>
constexpr Gain<Scalar> per_count(double signal) {
  if constexpr (is_fixed<Scalar>)
    return Gain<Scalar>(signal / digit<Scalar>());
  else
    return static_cast<Gain<Scalar>>(signal);
}

/// A PI from d1 and K_i = d0 + d1 per sample. Floating point stores d0, fixed point stores K_i (pi.hpp).
template <class Scalar>
PiConfig<Scalar> pi(double d1, double K_i, double limit) {
  if constexpr (is_fixed<Scalar>)
    return {Gain<Scalar>(d1), Gain<Scalar>(K_i), Scalar(limit)};
  else
    return {static_cast<Scalar>(d1), static_cast<Scalar>(K_i - d1), static_cast<Scalar>(limit)};
}

}  // namespace sixstep::control
