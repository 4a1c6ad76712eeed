// SPDX-License-Identifier: Apache-2.0
// check_pace() refuses numbers each of which may be, and which together make a drive so fast that its run
// would crawl.
#pragma once
#include "sixstep/base/problem.hpp"
#include "sixstep/design/sheet/parameters.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

void check_pace(const Scenario& s, const design::MotorModel& motor, base::Problems& out);

}  // namespace sixstep::study
