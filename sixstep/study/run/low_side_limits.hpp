// SPDX-License-Identifier: Apache-2.0
// Says up to which duty and which modulation low-side shunts show the currents.
#pragma once
#include <string>

#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace sixstep::study {

/// A sentence; empty for other current measurements.
std::string low_side_limits(const Scenario& scenario);

/// A sentence with the number of control periods in which the shunts showed too little; empty if there is none.
std::string blind_samples(const Scenario& scenario, const Outcome& outcome);

}  // namespace sixstep::study
