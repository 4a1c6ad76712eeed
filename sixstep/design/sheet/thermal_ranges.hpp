// SPDX-License-Identifier: Apache-2.0
// A motor file may give a range beside a thermal value, where sources differ. What a winding stands is then told
// twice: of the values, and of the ends of their ranges at which the winding gets warmest.
#pragma once
#include <optional>
#include <string>

#include "sixstep/design/sheet/thermal.hpp"

namespace sixstep::design {

struct WorseEnds {
  ThermalModel model;
  std::string values;  ///< those that differ, as the motor file writes them: "key = 11.7, key = 5.3"
};

/// Higher resistances, shorter time constants (at a given resistance that is less copper and iron to warm) and a
/// lower limit are worse. Empty where the sheet's thermal lines are not complete or no range has a worse end than
/// its value.
std::optional<WorseEnds> at_worse_ends(const Sheet& sheet);

/// How many times the rise of temperature above ambient may be what `model` says, a constant loss given: both
/// resistances and both heat capacities off by the most that one of them is.
double greater_rise(const ThermalModel& model, const ThermalModel& worse);

}  // namespace sixstep::design
