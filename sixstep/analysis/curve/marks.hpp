// SPDX-License-Identifier: Apache-2.0
// Finds speeds that lie between the curve's points:
// - the speed of greatest efficiency,
// - the speed above which the winding stays below its limit permanently,
// - the speed of the sheet's nominal torque.
//
// They are a maximum and roots on a separate sweep. The number of drawn points therefore has no influence.
#pragma once
#include <optional>
#include <vector>

#include "sixstep/analysis/curve/operating_point.hpp"
#include "sixstep/analysis/for_each.hpp"
#include "sixstep/design/sheet/thermal.hpp"

namespace sixstep::analysis {

struct Marks {
  std::optional<OperatingPoint> best_efficiency;  ///< empty: no point has an efficiency
  /// The winding stays below its limit from this point to no load. Empty if it exceeds the limit even at no
  /// load, or without thermal data.
  std::optional<OperatingPoint> for_ever;
  std::optional<OperatingPoint> nominal;  ///< the point of nominal torque; empty: none
};

/// Data for the marks other than the best efficiency.
struct MarksWanted {
  std::optional<design::ThermalModel> thermal;
  double ambient_degC = design::sheet_degC;
  double on_R = 1.0;  ///< ratio of the bench's winding resistance to the sheet's value
  std::optional<double> torque_Nm;
};

/// The sweep has equal steps from standstill to no load. The steps are small enough for one maximum and one
/// root between neighbours.
inline constexpr int sweep_steps = 16;
std::vector<double> sweep_speeds(double no_load_rad_s);

/// `sweep` contains the points at the sweep's speeds. The searches are independent, and `for_each` runs them.
/// At full duty, the speed of the flat maximum is exact to 1e-6 of the no-load speed, the speed of a root to
/// 1e-9. With chopping they are exact to 2e-3 and 1e-4, because a point's mean is known only within an
/// interval.
base::Result<Marks> find_marks(const Bench& bench, const MarksWanted& wanted,
                               const std::vector<OperatingPoint>& sweep, const ForEach& for_each);

}  // namespace sixstep::analysis
