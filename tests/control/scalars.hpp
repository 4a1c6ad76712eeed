// SPDX-License-Identifier: Apache-2.0
// The scalars that typed tests of control blocks run with, and their resolution.
#pragma once
#include <gtest/gtest.h>

#include <limits>
#include <type_traits>

#include "sixstep/control/fixed.hpp"

namespace sixstep::control {

/// 16 bits with room for a 1, and 32.
using Q14 = Fixed<std::int16_t, 14>;
using Q30 = Fixed<std::int32_t, 30>;
using Scalars = testing::Types<double, float, Q14, Q30>;

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

/// A gain that takes counts to signals: raw digits in fixed point.
template <class Scalar>
constexpr Gain<Scalar> per_count(double signal) {
  if constexpr (is_fixed<Scalar>)
    return Gain<Scalar>(signal / digit<Scalar>());
  else
    return static_cast<Gain<Scalar>>(signal);
}

}  // namespace sixstep::control
