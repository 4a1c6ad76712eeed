// SPDX-License-Identifier: Apache-2.0
// Computes the angle of a vector: rotates the vector onto the x axis in decreasing steps (CORDIC), with
// integers and without division. After 24 steps the error is 2^-24 rad plus 24 rounding errors, in total
// below 1e-5 degrees.
#pragma once
#include "sixstep/control/commissioning/field_vector.hpp"

namespace sixstep::control {

/// atan2(y, x) as a binary angle; 0 for the zero vector.
constexpr BinaryAngle vector_angle(std::int64_t x, std::int64_t y) {
  constexpr std::uint32_t steps[24] = {536870912u, 316933406u, 167458907u, 85004756u, 42667331u, 21354465u,
                                       10679838u,  5340245u,   2670163u,   1335087u,  667544u,   333772u,
                                       166886u,    83443u,     41722u,     20861u,    10430u,    5215u,
                                       2608u,      1304u,      652u,       326u,      163u,      81u};
  if (x == 0 && y == 0) return 0;
  BinaryAngle angle = 0;
  if (x < 0) {
    x = -x;
    y = -y;
    angle = half_turn;
  }
  // Multiplied by sqrt 2 and by 1.65, the gain of the steps, `most` still fits into an int64.
  constexpr std::int64_t most = std::int64_t{1} << 60;
  while (x < most / 4 && y < most / 4 && y > -most / 4) {
    x *= 2;
    y *= 2;
  }
  for (std::uint8_t n = 0; n < 24; ++n) {
    const std::int64_t dx = detail::shifted_down(x, n), dy = detail::shifted_down(y, n);
    if (y > 0) {
      x += dy;
      y -= dx;
      angle += steps[n];
    } else if (y < 0) {
      x -= dy;
      y += dx;
      angle -= steps[n];
    }
  }
  return angle;
}

}  // namespace sixstep::control
