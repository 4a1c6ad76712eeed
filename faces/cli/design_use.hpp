// SPDX-License-Identifier: Apache-2.0
// Checks which options of `sixstep design` each kind of design uses. An option without effect is refused by
// name, because the user expects an effect.
#pragma once
#include "faces/cli/design_arguments.hpp"
#include "sixstep/base/problem.hpp"
#include "sixstep/design/loops/drive_design.hpp"
#include "sixstep/design/sheet/sheet.hpp"

namespace cli {

/// Refuses options that a design of gains does not use in its mode, method and sensor.
base::Problems unread_by(const design::DesignSpec& spec, const DesignArguments& a);

/// Refuses options for the other kind of motor (rotary or linear).
base::Problems of_other_motion(const design::Sheet& sheet, const DesignArguments& a);

/// Refuses options that a field-oriented design does not read, because the scenario determines this design.
base::Problems unread_by_field_design(const DesignArguments& a);

/// Adds a warning if the sheet contradicts itself, because the gains are computed from it. `motor`: the
/// motor's name or file.
void warn_of_sheet(const design::Sheet& sheet, const std::string& motor,
                   std::vector<design::Warning>& warnings);

/// Refuses options that --optimise does not read, because the plan determines the optimisation.
base::Problems unread_by_optimise(const DesignArguments& a);

}  // namespace cli
