// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/scenario/scenario.hpp"
#include "text/rooms.hpp"

namespace text {

/// Everything the run found out, for other programs to read: verdicts, comparisons, gains, energy, events,
/// fault. Numbers that are not finite appear as null.
std::string json_summary(const study::Scenario& scenario, const study::Outcome& outcome);

}  // namespace text
