// SPDX-License-Identifier: Apache-2.0
// Speeds of the curve that an engineer asks for and that lie between its points: where the efficiency is
// greatest, from where on the winding stands it for ever, and where the sheet's nominal torque is given. They
// are found as a maximum and as roots, on a sweep of their own: how many points are drawn changes nothing.
#pragma once
#include <optional>
#include <vector>

#include "sixstep/analysis/curve/operating_point.hpp"
#include "sixstep/analysis/for_each.hpp"
#include "sixstep/design/sheet/thermal.hpp"

namespace sixstep::analysis {

struct Marks {
  std::optional<OperatingPoint> best_efficiency;  ///< empty where no point has any
  std::optional<OperatingPoint> for_ever;  ///< from here to no load the winding stays below its limit; empty
                                           ///< where no load itself does not, or nothing is known
  std::optional<OperatingPoint> nominal;   ///< where the asked torque is given; empty where nowhere
};

/// What to look for beside the best efficiency.
struct MarksWanted {
  std::optional<design::ThermalModel> thermal;
  double ambient_degC = design::sheet_degC;
  double on_R = 1.0;  ///< of the bench's winding, against the sheet's
  std::optional<double> torque_Nm;
};

/// From standstill to no load in equal steps, close enough for one maximum and one root between neighbours.
inline constexpr int sweep_steps = 16;
std::vector<double> sweep_speeds(double no_load_rad_s);

/// `sweep` are the points at those speeds. The searches are independent and run as `for_each` takes them. At
/// full duty a speed is found to 1e-6 of the whole for the flat maximum and to 1e-9 for a root; chopped,
/// where a point's mean is only known within its interval, to 2e-3 and 1e-4.
base::Result<Marks> find_marks(const Bench& bench, const MarksWanted& wanted,
                               const std::vector<OperatingPoint>& sweep, const ForEach& for_each);

}  // namespace sixstep::analysis
