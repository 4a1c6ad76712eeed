// SPDX-License-Identifier: Apache-2.0
// Calls of the C library that the check of symbols must find: a compiler cannot evaluate them.
#include <cmath>

double planted(double x, double y) { return std::pow(x, y) + std::sqrt(x); }
float planted(float x) { return std::sin(x); }
