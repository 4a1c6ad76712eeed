// SPDX-License-Identifier: Apache-2.0
// Writes the first screen of a report, with the verdict: the limiting requirement, the gains with their
// source, the current during a step, and the costs in energy and switching.
#pragma once
#include <string>

#include "sixstep/study/measure/outcome.hpp"
#include "sixstep/study/measure/trace.hpp"
#include "sixstep/study/scenario/scenario.hpp"

namespace report {

std::string glance_section(const sixstep::study::Scenario& scenario, const sixstep::study::Outcome& outcome,
                           const sixstep::study::Trace& trace);

}  // namespace report
