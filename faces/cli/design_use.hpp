// SPDX-License-Identifier: Apache-2.0
// Which options of `sixstep design` enter which kind of design. One that does not is refused by name: it was meant to do something.
#pragma once
#include "faces/cli/design_arguments.hpp"
#include "sixstep/base/problem.hpp"
#include "sixstep/design/loops/drive_design.hpp"
#include "sixstep/design/sheet/sheet.hpp"

namespace cli {

/// Of gains for a spec: what its mode, method and sensor do not read.
base::Problems unread_by(const design::DesignSpec& spec, const DesignArguments& a);

/// Options that only the other kind of motor has: one that turns, or one that moves along a line.
base::Problems of_other_motion(const design::Sheet& sheet, const DesignArguments& a);

/// Of a field-oriented drive, of which the scenario says all.
base::Problems unread_by_field_design(const DesignArguments& a);

/// Of --optimise, of which the plan says all.
base::Problems unread_by_optimise(const DesignArguments& a);

}  // namespace cli
