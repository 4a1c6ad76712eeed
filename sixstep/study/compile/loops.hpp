// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "sixstep/design/loops/drive_loops.hpp"
#include "sixstep/study/compile/basis.hpp"

namespace sixstep::study {

/// The controller of a scenario, without the changes of its events: loops and optional functions. Problems:
/// limits that the drive cannot keep.
base::Result<Tuned> tuned(const Scenario& scenario, const Basis& basis);

/// The winding on which the current controller's voltage acts. With smooth chopping it is the winding of a
/// pair with one chopped switch.
design::LoopWinding winding_of(const Scenario& scenario, const design::MotorModel& motor);

}  // namespace sixstep::study
