// SPDX-License-Identifier: Apache-2.0
// Keys that a scenario gives and that change nothing in its run, because what they belong to is not there.
#pragma once
#include <string>

#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// "sensors.current_noise_A (sensors.currents is ideal), heat.ambient_degC (nothing warms up)"; empty where all act. A key
/// that stands at its default counts as not given.
std::string unused_keys(const Scenario& scenario);

}  // namespace sixstep::study
