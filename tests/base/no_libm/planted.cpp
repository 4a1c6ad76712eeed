// SPDX-License-Identifier: Apache-2.0
// What the check of symbols must find: calls that a compiler cannot work out by itself.
#include <cmath>

double planted(double x, double y) { return std::pow(x, y) + std::sqrt(x); }
float planted(float x) { return std::sin(x); }
