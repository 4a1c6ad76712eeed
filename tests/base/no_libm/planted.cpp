// SPDX-License-Identifier: Apache-2.0
// These functions call the C library, and the compiler cannot replace the calls by constants. The check of
// symbols must find them.
#include <cmath>

double planted(double x, double y) { return std::pow(x, y) + std::sqrt(x); }
float planted(float x) { return std::sin(x); }
