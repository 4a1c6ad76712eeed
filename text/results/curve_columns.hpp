// SPDX-License-Identifier: Apache-2.0
// The columns of a torque-speed curve: one list for the CSV file and the JSON summary.
#pragma once
#include <span>
#include <vector>

#include "sixstep/study/curve/curve.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "text/rooms.hpp"

namespace text {

/// One point with all that is known of it; the thermal members are null where the sheet has no such lines.
struct CurveRow {
  const study::CurveRequest& request;
  const study::OperatingPoint& point;
  const study::ThermalLimits* limits = nullptr;
  const study::Warming* warming = nullptr;
};

struct CurveColumn {
  study::Column column;
  double (*value)(const CurveRow&);  ///< NaN: there is none
};

/// SI units, mechanical speed, phase currents; speed first.
std::span<const CurveColumn> curve_columns();

/// The rows of the curve's points, from standstill to no load.
std::vector<CurveRow> curve_rows(const study::CurveRequest& request, const study::Curve& curve);

/// Of a point that is not one of the curve's own.
struct LoosePoint {
  study::ThermalLimits limits;
  study::Warming warming;
};
LoosePoint loose_point(const study::CurveRequest& request, const study::Curve& curve,
                       const study::OperatingPoint& point);
CurveRow curve_row(const study::CurveRequest& request, const study::Curve& curve,
                   const study::OperatingPoint& point, const LoosePoint& thermal);

}  // namespace text
