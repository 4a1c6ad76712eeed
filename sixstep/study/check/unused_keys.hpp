// SPDX-License-Identifier: Apache-2.0
// Finds keys that a scenario gives without effect on its run, because the part that they configure is absent.
#pragma once
#include <string>

#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// "sensors.current_noise_A (sensors.currents is ideal), heat.ambient_degC (nothing warms up)"; empty if all
/// given keys have an effect. A key with its default value counts as not given. `ambient_is_used`: a remark of the run
/// was computed with heat.ambient_degC.
std::string unused_keys(const Scenario& scenario, bool ambient_is_used = false);

}  // namespace sixstep::study
