// SPDX-License-Identifier: Apache-2.0
// Checks the keys of [load] together with [initial].
#pragma once
#include "sixstep/base/result.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

void check_shaft(const Scenario& s, base::Problems& out);

}  // namespace sixstep::study
