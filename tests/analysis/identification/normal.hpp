// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cmath>
#include <numbers>

#include "tests/fuzz/draw.hpp"

namespace sixstep::testing {

/// A normal random number, mean 0 and standard deviation 1 (Box and Muller, 1958).
inline double normal(Draw& draw) {
  return std::sqrt(-2.0 * std::log(1.0 - draw.unit())) * std::cos(2.0 * std::numbers::pi * draw.unit());
}

}  // namespace sixstep::testing
