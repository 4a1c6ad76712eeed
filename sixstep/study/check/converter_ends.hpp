// SPDX-License-Identifier: Apache-2.0
// The largest values that a converter can read. The drive subtracts the current channel's offset from its
// readings. It does not subtract the bus channel's offset.
#pragma once
#include <cmath>

#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Largest current that the converter reads in either direction, A; meaningless (not above 0) without a
/// range.
inline double current_end_A(const Sensors& s) {
  const double range = s.current_range_A.value_or(0.0);
  return range - 2 * range / std::ldexp(1.0, s.adc_bits) - std::fabs(s.current_offset_A);
}

/// Largest bus voltage that the converter reads, V; 0 without a range.
inline double bus_end_V(const Sensors& s) {
  const double range = s.bus_range_V.value_or(0.0);
  return range - range / std::ldexp(1.0, s.adc_bits);
}

}  // namespace sixstep::study
