// SPDX-License-Identifier: Apache-2.0
// Torque-speed curve -> the JSON that curve.js draws from.
#pragma once
#include <string>

#include "sixstep/analysis/curve/curve.hpp"

namespace report {

/// {"axis": base64 float64 of rpm, of a linear motor with "speed": its unit, "charts":[{.., "curves":[{.., "data": base64
/// float32}]}]}: the curve's points and, in its place among them, the sheet's nominal speed.
std::string curve_charts(const sixstep::analysis::CurveRequest& request,
                         const sixstep::analysis::Curve& curve);

}  // namespace report
