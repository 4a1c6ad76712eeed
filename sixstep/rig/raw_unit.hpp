// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <type_traits>

namespace sixstep::rig {

/// Value of a raw unit, in which some gains have their output (adc.hpp, hall_speed.hpp): the last bit of a
/// fixed-point format, or 1 in floating point.
template <class Scalar>
double raw_unit() {
  if constexpr (std::is_arithmetic_v<Scalar>)
    return 1.0;
  else
    return static_cast<double>(Scalar::from_raw(1));
}

}  // namespace sixstep::rig
