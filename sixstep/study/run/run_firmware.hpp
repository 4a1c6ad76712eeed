// SPDX-License-Identifier: Apache-2.0
// One run with one firmware on the board's chip (rig/firmware.hpp). Each firmware in each arithmetic is a
// program of its own; a firmware's programs are compiled in the file named after it, so that a build does
// them side by side.
#pragma once
#include "sixstep/base/result.hpp"
#include "sixstep/study/compile/compile.hpp"
#include "sixstep/study/measure/observers.hpp"

namespace sixstep::study {

/// Problems: the arithmetic cannot hold the drive, or a defect of the engine. A fault is part of the outcome.
base::Problems run_lean(const Scenario& scenario, Compiled compiled, Observers& w, Outcome& out);
base::Problems run_sensed(const Scenario& scenario, Compiled compiled, Observers& w, Outcome& out);
base::Problems run_product(const Scenario& scenario, Compiled compiled, Observers& w, Outcome& out);

/// The same on the general kernel: the lean firmware is the sensed one whose sensors are ideal.
base::Problems run_sensed_on_general(const Scenario& scenario, Compiled compiled, Observers& w, Outcome& out);
base::Problems run_product_on_general(const Scenario& scenario, Compiled compiled, Observers& w,
                                      Outcome& out);

}  // namespace sixstep::study
