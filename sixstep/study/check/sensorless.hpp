// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "sixstep/base/problem.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// Checks the keys that a drive without a rotor sensor does not support, and the keys that only this drive
/// has.
void check_sensorless(const Scenario& scenario, base::Problems& out);

}  // namespace sixstep::study
