// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "sixstep/design/loops/drive_loops.hpp"
#include "sixstep/study/compile/basis.hpp"

namespace sixstep::study {

/// The controller of a scenario that does not change it: loops, extras, and limits that it can keep.
base::Result<Tuned> tuned(const Scenario& scenario, const Basis& basis);

/// The winding as the current controller's voltage sees it: by smooth chopping it is that of one switch on.
design::LoopWinding winding_of(const Scenario& scenario, const design::MotorModel& motor);

}  // namespace sixstep::study
