// SPDX-License-Identifier: Apache-2.0
// A motor file may contain a range for a thermal value if sources differ. A limit of a winding is then
// computed with the ends of the ranges at which the winding is warmest; the limit by the values is only a
// note.
#pragma once
#include <optional>
#include <string>

#include "sixstep/design/sheet/thermal.hpp"

namespace sixstep::design {

struct WorseEnds {
  ThermalModel model;
  std::string values;  ///< the values that differ, as in the motor file: "key = 11.7, key = 5.3"
};

/// The worse ends. Higher resistances, a lower limit and shorter time constants are worse. With a shorter
/// time constant at a given resistance, less copper and iron must be heated. Empty if the sheet's thermal
/// lines are incomplete, or if no range has an end worse than its value.
std::optional<WorseEnds> at_worse_ends(const Sheet& sheet);

/// Time for which a winding withstands a heating, s. Empty: without limit.
struct WithstandTimes {
  std::optional<double> by_values, by_worse_ends;   ///< equal if no range has an end worse than its value
  double limit_degC = 0.0, worse_limit_degC = 0.0;  ///< the winding's limit, which may have a range too

  bool differ() const { return by_values != by_worse_ends; }
};

/// From `start` on, or from ambient temperature. A verdict on safety uses `by_worse_ends`. Problem: the sheet's thermal
/// lines that are missing.
base::Result<WithstandTimes> withstand_times(const Sheet& sheet, const Heating& heating,
                                             const Temperatures& start);
base::Result<WithstandTimes> withstand_times(const Sheet& sheet, const Heating& heating);

/// The model for a safe limit: at the worse ends if there are any, else by the values. Problems as for
/// thermal_model().
base::Result<ThermalModel> safe_thermal_model(const Sheet& sheet);

/// Upper bound of the temperature rise above ambient by `worse` divided by the rise by `model`, at the same
/// constant loss. The bound assumes that both resistances and both heat capacities deviate by the largest of
/// their four deviations.
double greater_rise(const ThermalModel& model, const ThermalModel& worse);

}  // namespace sixstep::design
