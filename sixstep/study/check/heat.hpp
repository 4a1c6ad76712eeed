// SPDX-License-Identifier: Apache-2.0
// Checks [heat] together with the bridge's losses.
#pragma once
#include "sixstep/base/result.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

void check_heat(const Scenario& s, base::Problems& out);

}  // namespace sixstep::study
