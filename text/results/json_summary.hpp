// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/scenario/scenario.hpp"
#include "text/rooms.hpp"

namespace text {

/// All results of the run as JSON: verdicts, comparisons, gains, energy, events, fault. Numbers that are not
/// finite are null.
std::string json_summary(const study::Scenario& scenario, const study::Outcome& outcome);

}  // namespace text
