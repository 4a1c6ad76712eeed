// SPDX-License-Identifier: Apache-2.0
// Writes a torque-speed curve as the JSON from which curve.js draws.
#pragma once
#include <string>

#include "sixstep/analysis/curve/curve.hpp"

namespace report {

/// {"axis": base64 float64 of rpm, of a linear motor with "speed": its unit, "charts":[{.., "curves":[{..,
/// "data": base64 float32}]}]}: the points of the curve, with the sheet's nominal speed inserted in order.
std::string curve_charts(const sixstep::analysis::CurveRequest& request,
                         const sixstep::analysis::Curve& curve);

}  // namespace report
