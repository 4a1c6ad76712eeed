// SPDX-License-Identifier: Apache-2.0
// Elementary functions with the same bits on every platform. The last digit of the C library's functions
// differs between systems; code that can influence a trajectory therefore never calls them. The functions in
// this file use only + - * / and integer operations. Their error is below 1 ulp over the whole range,
// including subnormals (measured: tests/base/elementary_test.cpp). Special values are as in C's annex F;
// every NaN result is the same quiet NaN.
#pragma once

namespace sixstep::base {

double exp(double x);
double log(double x);            ///< natural logarithm; log(0) = -inf, NaN below 0
double pow(double x, double y);  ///< exact where the result is a double

struct SinCos {
  double sin = 0.0;
  double cos = 0.0;
};

/// Sine and cosine of any finite angle, rad. Beyond 2^20 the reduction uses as many digits of 2/pi as
/// necessary. NaN for an infinite angle.
SinCos sin_cos(double rad);
inline double sin(double rad) { return sin_cos(rad).sin; }
inline double cos(double rad) { return sin_cos(rad).cos; }

/// Angle of the point (x, y), rad, in [-pi, pi]. On the negative x axis the result is pi for y = 0 and -pi
/// for y = -0.
double atan2(double y, double x);

}  // namespace sixstep::base
