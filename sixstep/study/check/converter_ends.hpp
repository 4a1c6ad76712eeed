// SPDX-License-Identifier: Apache-2.0
// The most that a converter reads. A current's offset is taken off again by the drive, the bus's is not known to it.
#pragma once
#include <cmath>

#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Of either sign, A; 0 without a range.
inline double current_end_A(const Sensors& s) {
  const double range = s.current_range_A.value_or(0.0);
  return range - 2 * range / std::ldexp(1.0, s.adc_bits) - std::fabs(s.current_offset_A);
}

/// V; 0 without a range.
inline double bus_end_V(const Sensors& s) {
  const double range = s.bus_range_V.value_or(0.0);
  return range - range / std::ldexp(1.0, s.adc_bits);
}

}  // namespace sixstep::study
