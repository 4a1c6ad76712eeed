// SPDX-License-Identifier: Apache-2.0
// Elementary functions with the same bits on every platform. Nothing that can influence a trajectory calls the
// C library's, because their last digit differs between systems. These use only + - * / and integer operations.
// Their error is below 1 ulp over the whole range, subnormals included (measured:
// tests/base/elementary_test.cpp). Special values are as in C's annex F; each resulting NaN is the same quiet
// NaN.
#pragma once

namespace sixstep::base {

double exp(double x);
double log(double x);            ///< natural; log(0) = -inf, NaN below 0
double pow(double x, double y);  ///< exact where the result is a double

struct SinCos {
  double sin = 0.0;
  double cos = 0.0;
};

/// Any finite angle in rad: beyond 2^20 the reduction uses as many digits of 2/pi as the number needs.
SinCos sin_cos(double rad);
inline double sin(double rad) { return sin_cos(rad).sin; }
inline double cos(double rad) { return sin_cos(rad).cos; }

/// Angle of the point (x, y) in [-pi, pi]; the zeros' signs determine the side of the cut.
double atan2(double y, double x);

}  // namespace sixstep::base
