// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <type_traits>

namespace sixstep::rig {

/// Of a gain whose output is counted in raw units (adc.hpp, hall_speed.hpp): the last bit of a fixed format.
template <class Scalar>
double raw_unit() {
  if constexpr (std::is_arithmetic_v<Scalar>)
    return 1.0;
  else
    return static_cast<double>(Scalar::from_raw(1));
}

}  // namespace sixstep::rig
