// SPDX-License-Identifier: Apache-2.0
// The first screen's answers beside the verdict: what limits it, which gains and from where, what the current
// does during a step, what it cost in energy and switching.
#pragma once
#include <string>

#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace report {

std::string glance_section(const sixstep::study::Scenario& scenario, const sixstep::study::Outcome& outcome,
                           const sixstep::study::Trace& trace);

}  // namespace report
