// SPDX-License-Identifier: Apache-2.0
// Writes a torque-speed curve as the JSON that curve.js draws.
#pragma once
#include <string>

#include "sixstep/analysis/curve/curve.hpp"

namespace report {

/// {"axis": base64 float64, "charts":[{.., "curves":[{.., "data": base64 float32}]}]}. The axis is the speed
/// in rpm; for a linear motor, "speed" names its unit. The sheet's nominal speed is inserted into the points
/// in order.
std::string curve_charts(const sixstep::analysis::CurveRequest& request,
                         const sixstep::analysis::Curve& curve);

}  // namespace report
