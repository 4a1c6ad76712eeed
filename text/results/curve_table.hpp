// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "sixstep/analysis/curve/curve.hpp"
#include "text/rooms.hpp"

namespace text {

/// The curve in an engineer's units, at most a dozen of its points, and in words what belongs to it: the
/// ideal line, no load with the free rotor's check, the sheet's nominal point, the thermal region, and how
/// sure the numbers are.
std::string curve_table(const analysis::CurveRequest& request, const analysis::Curve& curve);

}  // namespace text
