// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "sixstep/base/problem.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// What a drive without a rotor sensor cannot do, and what only it does.
void check_sensorless(const Scenario& scenario, base::Problems& out);

}  // namespace sixstep::study
