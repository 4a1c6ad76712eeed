// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "sixstep/analysis/curve/curve.hpp"
#include "text/rooms.hpp"

namespace text {

/// The curve in an engineer's units, with at most a dozen points. Below it are, in words:
/// - the ideal line;
/// - no load, with the check by the free rotor;
/// - the sheet's nominal point;
/// - the thermal limits;
/// - how exact the numbers are.
std::string curve_table(const analysis::CurveRequest& request, const analysis::Curve& curve);

}  // namespace text
