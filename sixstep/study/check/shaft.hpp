// SPDX-License-Identifier: Apache-2.0
// What the keys of [load] and the start say together.
#pragma once
#include "sixstep/base/result.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

void check_shaft(const Scenario& s, base::Problems& out);

}  // namespace sixstep::study
