// SPDX-License-Identifier: Apache-2.0
// A motor file may give a range for a thermal value where sources differ. The limits of a winding are then
// computed twice: with the values, and with those ends of their ranges at which the winding gets warmest.
#pragma once
#include <optional>
#include <string>

#include "sixstep/design/sheet/thermal.hpp"

namespace sixstep::design {

struct WorseEnds {
  ThermalModel model;
  std::string values;  ///< the values that differ, as the motor file writes them: "key = 11.7, key = 5.3"
};

/// The worse ends. Higher resistances and a lower limit are worse, and so are shorter time constants, because
/// at a given resistance less copper and iron must be heated. Empty if the sheet's thermal lines are
/// incomplete, or if no range has an end worse than its value.
std::optional<WorseEnds> at_worse_ends(const Sheet& sheet);

/// Largest factor on the temperature rise above ambient that `model` gives, at a constant loss. It assumes
/// that both resistances and both heat capacities deviate by the largest deviation of one of them.
double greater_rise(const ThermalModel& model, const ThermalModel& worse);

}  // namespace sixstep::design
