// SPDX-License-Identifier: Apache-2.0
// Checks which options of `sixstep design` each kind of design uses. An option without effect is refused by
// name, because the user expects an effect.
#pragma once
#include "faces/cli/design_arguments.hpp"
#include "sixstep/base/problem.hpp"
#include "sixstep/design/loops/drive_design.hpp"
#include "sixstep/design/sheet/sheet.hpp"

namespace cli {

/// Options that a design of gains does not use in its mode, method and sensor.
base::Problems unread_by(const design::DesignSpec& spec, const DesignArguments& a);

/// Problems of options that only the other kind of motor has (rotary or linear).
base::Problems of_other_motion(const design::Sheet& sheet, const DesignArguments& a);

/// Refuses options that a field-oriented design does not read, because the scenario determines this design.
base::Problems unread_by_field_design(const DesignArguments& a);

/// Warns of a sheet that contradicts itself, because gains follow from its values. `motor`: the motor's name
/// or file.
void warn_of_sheet(const design::Sheet& sheet, const std::string& motor,
                   std::vector<design::Warning>& warnings);

/// Refuses options that --optimise does not read, because the plan determines the optimisation.
base::Problems unread_by_optimise(const DesignArguments& a);

}  // namespace cli
