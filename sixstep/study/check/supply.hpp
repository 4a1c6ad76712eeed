// SPDX-License-Identifier: Apache-2.0
// What the keys of [supply] say together.
#pragma once
#include "sixstep/base/result.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

void check_supply(const Scenario& s, base::Problems& out);

}  // namespace sixstep::study
