// SPDX-License-Identifier: Apache-2.0
// Lists the columns of a torque-speed curve, for the CSV file and the JSON summary.
#pragma once
#include <span>
#include <string>
#include <vector>

#include "sixstep/analysis/curve/curve.hpp"
#include "sixstep/base/linear.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "text/rooms.hpp"

namespace text {

/// One point with all its results. The thermal members are null if the sheet has no thermal values.
struct CurveRow {
  const analysis::CurveRequest& request;
  const analysis::OperatingPoint& point;
  const analysis::ThermalLimits* limits = nullptr;
  const analysis::Warming* warming = nullptr;
};

struct CurveColumn {
  study::Column column;
  double (*value)(const CurveRow&);  ///< NaN: no value
};

/// Columns in SI units, with mechanical speed and phase currents; the speed comes first. For a linear motor,
/// the same values have other names.
std::span<const CurveColumn> curve_columns(const base::Motion& motion = {});

/// The conditions of a curve's rows that no column contains: "the row at speed 0 without friction; limits and
/// temperatures at 25 degC ambient and the worse ends ..".
std::string curve_conditions(const analysis::CurveRequest& request);

/// The rows of the curve's points, from standstill to no load.
std::vector<CurveRow> curve_rows(const analysis::CurveRequest& request, const analysis::Curve& curve);

/// Thermal results of a point that is not one of the curve's points.
struct LoosePoint {
  analysis::ThermalLimits limits;
  analysis::Warming warming;
};
LoosePoint loose_point(const analysis::CurveRequest& request, const analysis::Curve& curve,
                       const analysis::OperatingPoint& point);
CurveRow curve_row(const analysis::CurveRequest& request, const analysis::Curve& curve,
                   const analysis::OperatingPoint& point, const LoosePoint& thermal);

}  // namespace text
